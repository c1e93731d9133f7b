// By how much the loupe enlarges: powers of ten, continuous between them, never more than fits.
#include "draw/overlays/zoom.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

/// A level at each moment of a video, in seconds.
using Levels = int (*)(double video_s);

double eased(Levels levels, double video_s) {
  return eased_level([&](double from_now_s) { return levels(video_s + from_now_s); });
}

TEST(EasedLevel, TakesItsTimeFromOneLevelToTheNext) {
  const Levels rise = [](double s) { return s < 2 ? 3 : 4; };
  const Levels fall = [](double s) { return s < 2 ? 4 : 3; };
  for (double s = 0; s < 4; s += 0.01) {
    const double way = std::clamp((s - 2) / 0.4, 0.0, 1.0);
    EXPECT_NEAR(eased(rise, s), 3 + way * way * (3 - 2 * way), 1e-3) << s;
    // It has fallen when the level falls.
    const double back = std::clamp((s - 1.6) / 0.4, 0.0, 1.0);
    EXPECT_NEAR(eased(fall, s), 4 - back * back * (3 - 2 * back), 1e-3) << s;
  }
  EXPECT_EQ(eased(rise, 1.99), 3);
  EXPECT_EQ(eased(rise, 2.5), 4);
}

TEST(EasedLevel, NeverExceedsTheLevelAndLeavesOutWhatIsShort) {
  const Levels steps = [](double s) {
    return s < 1 ? 0 : s < 1.1 ? 2 : s < 1.9 ? 5 : s < 2.05 ? 3 : s < 2.2 ? 1 : 0;
  };
  const Levels spike = [](double s) { return 1 < s && s < 1.3 ? 9 : 1; };
  double before = 0;
  double most = 0;
  for (double s = 0; s < 4; s += 1.0 / 240) {
    const double now = eased(steps, s);
    EXPECT_LE(now, steps(s) + 1e-9) << s;
    // Five levels in an ease at most, half as steep again in its middle.
    EXPECT_LE(std::fabs(now - before), 5 * 1.5 / 0.4 / 240 + 0.01) << s;
    before = now;
    most = std::max(most, now);
    EXPECT_NEAR(eased(spike, s), 1, 1e-9);
  }
  EXPECT_GT(most, 4);
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
