#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

#include <limits>

#include "core/two_sum.hpp"

namespace piblocks {
namespace {

TEST(Time, HoldsMoreThanADouble) {
  const Rational exact = Rational(1) / 3;
  const Time time = to_time(exact);
  EXPECT_EQ(time.hi, 1.0 / 3.0);
  EXPECT_NE(time.lo, 0.0);
  EXPECT_LT(abs(to_rational(time) - exact), parse_rational("1e-32"));
}

TEST(Time, IsExactForDoubles) {
  EXPECT_EQ(to_time(Rational(0.1)), (Time{0.1, 0}));
  EXPECT_EQ(to_rational({0.1, 0}), Rational(0.1));
}

TEST(Time, RefusesWhatIsNotFinite) {
  EXPECT_THROW(to_rational({std::numeric_limits<double>::infinity(), 0}), SimulationError);
}

TEST(TwoSum, LosesNothing) {
  const Time sum = two_sum(1e16, 1.25);
  EXPECT_EQ(Rational(sum.hi) + Rational(sum.lo), Rational(1e16) + Rational(1.25));
  const Time swapped = two_sum(1.25, 1e16);
  EXPECT_EQ(sum, swapped);
}

}  // namespace
}  // namespace piblocks
