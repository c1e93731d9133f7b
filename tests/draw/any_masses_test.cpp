// Overlays and diagrams of systems whose mass ratio, or a root of it, is beyond a double.
#include <gtest/gtest.h>
#include <piblocks/script.hpp>

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

using Setting = std::pair<const char*, std::string>;

struct Pictures {
  explicit Pictures(const Scene& scene)
      : log(make_pair_log(scene.system)), composition(scene, *log) {}

  DrawList at(const Rational& time) const { return composition.frame({log->state_at(time), time}); }

  std::unique_ptr<PairLog> log;
  Composition composition;
};

std::string text_of(const DrawList& list, ItemId id) {
  for (const DrawItem& item : list.items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && text->id == id) return text->text;
  }
  return {};
}

/// "red 1.25 + blue 3.75 = 5" and the like: the number after a word.
double number_after(std::string text, const std::string& word) {
  std::erase(text, ',');
  return std::stod(text.substr(text.find(word) + word.size()));
}

/// No collisions: then red may be as light as one likes.
Scene apart(const char* mass_ratio, std::vector<Setting> settings) {
  ScriptBuilder builder;
  settings.insert(settings.begin(), {{"mass-ratio", mass_ratio},
                                     {"red.velocity", "1"},
                                     {"blue.velocity", "0"},
                                     {"time.to", "5"}});
  for (const auto& [key, text] : settings) builder.set("test", key, text);
  return builder.build_scene();
}

TEST(Overlays, MomentumAndArrowsHoldAnyMasses) {
  for (const char* ratio : {"1e-900", "1e-700", "1e-320", "1", "1e320", "1e600"}) {
    const Pictures pictures(apart(ratio, {{"show.overlays", "velocities,momentum,energy"}}));
    const DrawList list = pictures.at(1);
    // All momentum is red's, and so is all energy.
    const std::string momentum = text_of(list, nth(ItemId::read_outs, 1));
    EXPECT_EQ(number_after(momentum, "red "), number_after(momentum, "sum ")) << momentum;
    EXPECT_EQ(number_after(momentum, "blue "), 0) << momentum;
    const std::string energy = text_of(list, ItemId::read_outs);
    EXPECT_EQ(number_after(energy, "red "), number_after(energy, "= ")) << energy;
    EXPECT_TRUE(std::ranges::any_of(list.items,
                                    [](const DrawItem& item) {
                                      const auto* path = std::get_if<PathItem>(&item);
                                      return path != nullptr && path->id == ItemId::velocities;
                                    }))
        << "no arrow at " << ratio;
  }
}

/// The point that marks the present in a diagram, from the middle of its sheet, in pixels.
std::optional<Point> present_of(const DrawList& list) {
  for (const DrawItem& item : list.items) {
    if (const auto* disc = std::get_if<DiscItem>(&item)) return disc->centre;
  }
  return std::nullopt;
}

TEST(Panels, MarkThePresentForAnyMasses) {
  for (const char* ratio : {"1e-900", "1e-700", "1e-320", "1e320", "1e600"}) {
    for (const char* panel : {"velocity", "position", "unfolded"}) {
      const Pictures pictures(apart(ratio, {{"show.panels", panel}}));
      const std::optional<Point> present = present_of(pictures.at(1));
      ASSERT_TRUE(present) << panel << " at " << ratio;
      EXPECT_TRUE(present->x > 0 && present->x < 1920 && present->y > 0 && present->y < 1080)
          << panel << " at " << ratio << ": " << present->x << ", " << present->y;
    }
  }
}

TEST(Panels, UnfoldALineOfAnyLength) {
  for (const char* position : {"5", "1e100", "1e200", "1e300"}) {
    const Pictures pictures(apart("1", {{"show.panels", "unfolded"}, {"red.position", position}}));
    bool has_wedge = false;
    for (const DrawItem& item : pictures.at(1).items) {
      const auto* path = std::get_if<PathItem>(&item);
      if (path == nullptr || !path->closed) continue;
      has_wedge = true;
      for (const Point& point : path->points.view()) {
        EXPECT_TRUE(point.x >= 0 && point.x <= 1920 && point.y >= 0 && point.y <= 1080) << position;
      }
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
