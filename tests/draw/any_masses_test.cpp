// Overlays and diagrams of systems whose mass ratio, or a root of it, is beyond a double.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "draw/composed_pictures.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

/// No collisions: then red may be as light as one likes.
Pictures apart(const char* mass_ratio, const Settings& settings) {
  return Pictures(scene_with(Settings{{"mass-ratio", mass_ratio},
                                      {"red.velocity", "1"},
                                      {"blue.velocity", "0"},
                                      {"time.to", "5"}} +
                             settings));
}

TEST(Overlays, MomentumAndArrowsHoldAnyMasses) {
  for (const char* ratio : {"1e-900", "1e-700", "1e-320", "1", "1e320", "1e600"}) {
    const Pictures pictures = apart(ratio, {{"show.overlays", "velocities,momentum,energy"}});
    const DrawList list = pictures.at(1);
    // All momentum is red's, and so is all energy.
    const std::string momentum = text_of(list, nth(ItemId::read_outs, 1));
    EXPECT_EQ(number_after(momentum, "red "), number_after(momentum, "sum ")) << momentum;
    EXPECT_EQ(number_after(momentum, "blue "), 0) << momentum;
    const std::string energy = text_of(list, ItemId::read_outs);
    EXPECT_EQ(number_after(energy, "red "), number_after(energy, "= ")) << energy;
    EXPECT_TRUE(find_item<PathItem>(list, ItemId::velocities)) << "no arrow at " << ratio;
  }
}

TEST(Panels, MarkThePresentForAnyMasses) {
  for (const char* ratio : {"1e-900", "1e-700", "1e-320", "1e320", "1e600"}) {
    for (const char* panel : {"velocity", "position", "unfolded"}) {
      const Shown shown(apart(ratio, {{"show.panels", panel}}).at(1));
      ASSERT_FALSE(shown.discs.empty()) << panel << " at " << ratio;
      const Point& present = shown.discs.front().centre;
      EXPECT_TRUE(present.x > 0 && present.x < 1920 && present.y > 0 && present.y < 1080)
          << panel << " at " << ratio << ": " << present.x << ", " << present.y;
    }
  }
}

TEST(Panels, UnfoldALineOfAnyLength) {
  for (const char* position : {"5", "1e100", "1e200", "1e300"}) {
    const Pictures pictures = apart("1", {{"show.panels", "unfolded"}, {"red.position", position}});
    bool has_wedge = false;
    for (const PathItem& path : items_of<PathItem>(pictures.at(1).items)) {
      if (!path.closed) continue;
      has_wedge = true;
      EXPECT_TRUE((Rect{0, 0, 1920, 1080}).holds(path.points.bounds())) << position;
    }
    EXPECT_TRUE(has_wedge) << "the wedge that the present is in, at " << position;
  }
}

TEST(Panels, KnowTheWedgeHoweverNarrowOrWide) {
  TwoBlocks system;
  for (const unsigned long exponent : {4UL, 40UL, 400UL, 648UL, 700UL, 4000UL}) {
    system.red.mass = power(10, exponent);
    const GapWedge narrow(system);
    const double half = double(exponent) / 2;
    const Magnitude theta = narrow.theta_magnitude();
    EXPECT_NEAR(std::log10(theta.mantissa) + double(theta.exponent), -half, 1e-4) << exponent;
    EXPECT_NEAR(narrow.angle({1, long(exponent) / 2}), 1, 1e-4) << exponent;
    EXPECT_NEAR(narrow.cosine, 1, 1e-4);
    system.red.mass = 1 / power(10, exponent);
    const GapWedge wide(system);
    EXPECT_NEAR(wide.theta, std::numbers::pi / 2, 0.011) << exponent;
    EXPECT_NEAR(wide.sine, 1, 1e-4);
    EXPECT_TRUE(wide.cosine >= 0 && wide.cosine < 0.011) << exponent;
  }
}

}  // namespace
}  // namespace piblocks
