// By how much the loupe enlarges: powers of ten, continuous between them, never more than fits.
#include "draw/overlays/zoom.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace piblocks {
namespace {

TEST(Zoom, RisesWithoutJumpsAndNeverBeyondItsRoom) {
  const Zoom zoom(20);
  constexpr double kStep = 1.0001;
  double before = zoom.factor_for(1e-3);
  EXPECT_EQ(before, 1);
  for (double room = 1e-3; room < 1e22; room *= kStep) {
    const double now = zoom.factor_for(room);
    EXPECT_LE(now, std::max(1.0, room)) << room;
    EXPECT_GE(now, before) << room;
    // Its steepest rise is the fourth power.
    EXPECT_LE(now, before * std::pow(kStep, 5)) << room;
    before = now;
  }
}

TEST(Zoom, StaysAtPowersOfTen) {
  const Zoom zoom(20);
  for (long exponent = 1; exponent <= 20; ++exponent) {
    const double power = std::pow(10.0, double(exponent));
    for (const double share : {1.000001, 2.0, 3.0}) {
      EXPECT_NEAR(zoom.factor_for(power * share) / power, 1, 1e-14) << exponent;
    }
    EXPECT_EQ(zoom.exponent_of(zoom.power(exponent)), exponent);
  }
  EXPECT_EQ(zoom.factor_for(std::numeric_limits<double>::infinity()), zoom.power(20));
}

TEST(Zoom, ItsLogarithmIsNearTheTrueOneAndHasAnInverse) {
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    EXPECT_NEAR(straight_log2(x), std::log2(x), 0.0861);
    EXPECT_NEAR(straight_exp2(straight_log2(x)) / x, 1, 1e-12);
  }
  for (int exponent = -40; exponent < 40; ++exponent) {
    EXPECT_EQ(straight_log2(std::ldexp(1.0, exponent)), exponent);
  }
}

}  // namespace
}  // namespace piblocks
