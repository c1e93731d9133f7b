#include "core/rounded.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "support/rounding_check.hpp"

namespace piblocks {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();
constexpr double kMost = std::numeric_limits<double>::max();
constexpr double kPi = std::numbers::pi;

struct SpecialValue {
  const char* function;
  double x;
  double y;
  double value;
};

/// IEEE 754-2008, 9.2.1; C17, F.10.
constexpr SpecialValue kSpecialValues[] = {
    {"sin", 0.0, 0, 0.0},
    {"sin", -0.0, 0, -0.0},
    {"sin", kInfinity, 0, kNan},
    {"sin", -kInfinity, 0, kNan},
    {"sin", kNan, 0, kNan},
    {"sin", kLeast, 0, kLeast},
    {"sin", -0x1p-1022, 0, -0x1p-1022},
    {"sin", 0x1p-27, 0, 0x1p-27},
    {"sin", 0x1p-25, 0, 0x1.fffffffffffffp-26},
    {"sin", kPi, 0, 0x1.1a62633145c07p-53},
    {"sin", 0x1p120, 0, 0.37782010936075202},
    {"sin", kMost, 0, 0x1.452fc98b34e97p-8},
    {"cos", 0.0, 0, 1},
    {"cos", -0.0, 0, 1},
    {"cos", kInfinity, 0, kNan},
    {"cos", kNan, 0, kNan},
    {"cos", kLeast, 0, 1},
    {"cos", kPi, 0, -1},
    {"cos", kPi / 2, 0, 0x1.1a62633145c07p-54},
    {"exp", 0.0, 0, 1},
    {"exp", -0.0, 0, 1},
    {"exp", kInfinity, 0, kInfinity},
    {"exp", -kInfinity, 0, 0.0},
    {"exp", kNan, 0, kNan},
    {"exp", 1, 0, std::numbers::e},
    {"exp", kLeast, 0, 1},
    {"exp", 0x1.62e42fefa39efp+9, 0, 0x1.fffffffffff2ap+1023},
    {"exp", 0x1.62e42fefa39fp+9, 0, kInfinity},
    {"exp", -745.13, 0, kLeast},
    {"exp", -745.14, 0, 0.0},
    {"log", 1, 0, 0.0},
    {"log", 0.0, 0, -kInfinity},
    {"log", -0.0, 0, -kInfinity},
    {"log", -1, 0, kNan},
    {"log", kInfinity, 0, kInfinity},
    {"log", kNan, 0, kNan},
    {"log", kLeast, 0, -0x1.74385446d71c3p+9},
    {"log", kMost, 0, 0x1.62e42fefa39efp+9},
    {"log10", 1, 0, 0.0},
    {"log10", 0.0, 0, -kInfinity},
    {"log10", 1e22, 0, 22},
    {"log10", 1e-5, 0, -5},
    {"log1p", 0.0, 0, 0.0},
    {"log1p", -0.0, 0, -0.0},
    {"log1p", -1, 0, -kInfinity},
    {"log1p", -2, 0, kNan},
    {"log1p", kInfinity, 0, kInfinity},
    {"log1p", kLeast, 0, kLeast},
    {"log1p", 0x1p-53, 0, 0x1p-53},
    {"log1p", 0x1p-52, 0, 0x1.fffffffffffffp-53},
    {"log1p", kMost, 0, 0x1.62e42fefa39efp+9},
    {"hypot", 0.0, 0.0, 0.0},
    {"hypot", -0.0, -0.0, 0.0},
    {"hypot", 3, -4, 5},
    {"hypot", kInfinity, kNan, kInfinity},
    {"hypot", kNan, -kInfinity, kInfinity},
    {"hypot", kNan, 0, kNan},
    {"hypot", kLeast, 0.0, kLeast},
    {"hypot", 3 * kLeast, 4 * kLeast, 5 * kLeast},
    {"hypot", kLeast, kLeast, kLeast},
    {"hypot", 0x3p1000, 0x4p1000, 0x5p1000},
    {"hypot", kMost, kMost, kInfinity},
    {"hypot", kMost, 1, kMost},
    {"atan2", 0.0, 1, 0.0},
    {"atan2", -0.0, 1, -0.0},
    {"atan2", 0.0, 0.0, 0.0},
    {"atan2", -0.0, 0.0, -0.0},
    {"atan2", 0.0, -0.0, kPi},
    {"atan2", -0.0, -1, -kPi},
    {"atan2", 1, 0.0, kPi / 2},
    {"atan2", -1, -0.0, -kPi / 2},
    {"atan2", kInfinity, kInfinity, kPi / 4},
    {"atan2", -kInfinity, -kInfinity, -3 * kPi / 4},
    {"atan2", 1, kInfinity, 0.0},
    {"atan2", -1, -kInfinity, -kPi},
    {"atan2", kInfinity, 1, kPi / 2},
    {"atan2", kNan, 1, kNan},
    {"atan2", kLeast, 1, kLeast},
    {"atan2", kLeast, 2, 0.0},
    {"atan2", kLeast, kLeast, kPi / 4},
    {"atan2", kMost, -kMost, 3 * kPi / 4},
};

TEST(Rounded, HasTheSpecialValuesOfTheStandards) {
  for (const SpecialValue& special : kSpecialValues) {
    const auto function = std::ranges::find(kRoundedFunctions, std::string_view(special.function),
                                            &RoundedFunction::name);
    const double value = function->rounded(special.x, special.y);
    EXPECT_TRUE(is_same(value, special.value))
        << special.function << "(" << special.x << ", " << special.y << ") = " << value
        << " instead of " << special.value;
  }
}

TEST(Rounded, SineAndCosineAreThoseOfTheirPair) {
  for (const double x : {0.0, -0.0, 1e-9, 0.5, -2.0, kPi, 1000.0, 1e10, kLeast, kMost, kInfinity}) {
    const auto [sine, cosine] = rounded::sin_cos(x);
    EXPECT_TRUE(is_same(sine, rounded::sin(x))) << x;
    EXPECT_TRUE(is_same(cosine, rounded::cos(x))) << x;
  }
}

/// Where a function has a symmetry, correct rounding has it too.
TEST(Rounded, FunctionsAreAsSymmetricAsTheyShould) {
  Random random(5);
  for (int i = 0; i < 10'000; ++i) {
    const double x = random.uniform(-30, 30);
    const double y = random.uniform(-30, 30);
    EXPECT_EQ(rounded::sin(-x), -rounded::sin(x));
    EXPECT_EQ(rounded::cos(-x), rounded::cos(x));
    EXPECT_EQ(rounded::atan2(-y, x), -rounded::atan2(y, x));
    EXPECT_EQ(rounded::hypot(x, y), rounded::hypot(-y, x));
    const double scale = std::ldexp(1, static_cast<int>(random.integer(-900, 900)));
    EXPECT_EQ(rounded::atan2(y * scale, x * scale), rounded::atan2(y, x));
    EXPECT_EQ(rounded::hypot(x * scale, y * scale), rounded::hypot(x, y) * scale);
  }
}

TEST(Rounded, FunctionsRiseAndFallFromOneDoubleToTheNext) {
  Random random(6);
  for (int i = 0; i < 10'000; ++i) {
    const double x = random.uniform(0, 3);
    const double next = std::nextafter(x, kInfinity);
    EXPECT_LE(rounded::exp(x), rounded::exp(next));
    EXPECT_LE(rounded::log(x), rounded::log(next));
    EXPECT_GE(rounded::cos(x), rounded::cos(next));
    EXPECT_LE(rounded::atan2(x, 2), rounded::atan2(next, 2));
    EXPECT_LE(rounded::hypot(x, 1), rounded::hypot(next, 1));
  }
}

}  // namespace
}  // namespace piblocks
