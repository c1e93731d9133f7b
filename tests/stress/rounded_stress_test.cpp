// The elementary functions, held to MPFR at many arguments.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>

#include "core/near_functions.hpp"
#include "support/rounding_check.hpp"

namespace piblocks {
namespace {

class RoundedFunctions : public testing::TestWithParam<RoundedFunction> {};

TEST_P(RoundedFunctions, RoundCorrectly) {
  const RoundedFunction& function = GetParam();
  const std::int64_t arguments = many(100'000);
  const RoundingTally tally = check_rounding(function, arguments, Random(11), 16);
  const auto share = [&](std::int64_t count) { return double(count) / double(arguments); };
  fmt::print(
      "{}: {} arguments, {} wrong; MPFR: {:.2g} outside, {:.2g} undecided; error of the "
      "approximation {:.2f} of its bound (at {:a}, {:a}); unlike the C library {:.2g}\n",
      function.name, arguments, tally.wrong, share(tally.outside), share(tally.undecided),
      tally.largest_error / near::kNearError, tally.largest_error_at[0], tally.largest_error_at[1],
      share(tally.unlike_c));
  EXPECT_EQ(tally.wrong, 0) << fmt::format("at {:a}, {:a}", tally.wrong_at[0], tally.wrong_at[1]);
  EXPECT_LT(tally.largest_error, near::kNearError);
  // The arguments are so many that both ways to the value are taken, and that they can tell this
  // function from the C library's, which does not always round correctly.
  EXPECT_GT(tally.outside + tally.undecided, 0);
  EXPECT_GT(tally.unlike_c, 0);
}

INSTANTIATE_TEST_SUITE_P(All, RoundedFunctions, testing::ValuesIn(kRoundedFunctions),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           std::ranges::replace(name, '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace piblocks
