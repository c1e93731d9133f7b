// Sliders and one more body: whatever they offer is accepted.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "scene/shipped_scenes.hpp"
#include "web/choices.hpp"
#include "web/facts.hpp"
#include "web/opening.hpp"

namespace piblocks::web {
namespace {

using Ranges = std::map<std::string, std::array<double, 2>>;

Ranges ranges_of(const std::string& text, const std::string& settings = "") {
  const OpenedScript opened = open_script({text, settings, "frame 0", ""});
  const std::string json = ranges_json(*opened.builder, *opened.live);
  Ranges ranges;
  // "KEY":[LOW,HIGH] each
  for (std::size_t at = 0; (at = json.find('[', at)) != std::string::npos; ++at) {
    const std::size_t comma = json.find(',', at);
    const std::size_t name = json.rfind('"', at - 3) + 1;
    ranges[json.substr(name, at - 2 - name)] = {std::stod(json.substr(at + 1)),
                                                std::stod(json.substr(comma + 1))};
  }
  return ranges;
}

using Ends = std::array<double, 2>;

TEST(Ranges, AreUpToWhatIsBeside) {
  const Ranges ranges = ranges_of(
      "wall.face = 1\nblue.position = 3\nred.position = 7\nblue.width = 1.5\nred.width = 2\n"
      "view.x = [0, 11]\n");
  EXPECT_EQ(ranges.at("blue.position"), (Ends{1.75, 5.25}));
  EXPECT_EQ(ranges.at("red.position"), (Ends{4.75, 10}));
  EXPECT_EQ(ranges.at("blue.width"), (Ends{0.1, 3}));
  EXPECT_EQ(ranges.at("red.width"), (Ends{0.1, 3}));
  EXPECT_EQ(ranges.at("digits"), (Ends{1, 20}));
  EXPECT_EQ(ranges.at("base"), (Ends{2, 36}));
  EXPECT_EQ(ranges.at("view.shutter"), (Ends{0, 1}));
  EXPECT_EQ(ranges.at("blocks.restitution"), (Ends{0, 1}));
}

TEST(Ranges, HoldTheValueOfTheScene) {
  const Ranges ranges = ranges_of("red.velocity = -8\ndigits = 25\ntime.speed = 9\n");
  EXPECT_EQ(ranges.at("red.velocity"), (Ends{-8, 3}));
  EXPECT_EQ(ranges.at("digits"), (Ends{1, 25}));
  EXPECT_EQ(ranges.at("time.speed"), (Ends{0.05, 9}));
}

TEST(Ranges, EndAHairBeforeWhatIsRefused) {
  // 7/3 is no double.
  const Ranges ranges = ranges_of("blue.position = 1\nred.position = \"17/6\"\n");
  const double high = ranges.at("blue.position")[1];
  EXPECT_NEAR(high, 11.0 / 6, 1e-12);
  EXPECT_LE(rational_from_decimal(high), Rational(11, 6));
}

TEST(Ranges, FollowWidthsByMass) {
  // Red becomes wider with blue, so blue's share of the gap is less.
  const std::string text = "digits = 3\nblue.position = 2\nred.position = 4\n";
  EXPECT_LT(ranges_of(text + "red.width = \"by-mass\"\n").at("blue.width")[1], 2);
  EXPECT_EQ(ranges_of(text).at("blue.width")[1], 3);
}

TEST(Ranges, OfTransparentPictures) {
  EXPECT_EQ(ranges_of("view.background = \"transparent\"\n").at("view.shutter"), (Ends{0, 0}));
}

TEST(Ranges, OfOtherScenes) {
  const Ranges ranges = ranges_of("time.to = 1\n[[body]]\nposition = 1\nvelocity = 1\n");
  EXPECT_EQ(ranges.count("blue.position"), 0U);
  EXPECT_EQ(ranges.count("time.speed"), 1U);
  EXPECT_TRUE(ranges_of("[[part]]\ncard = [\"A\"]\n").empty());
}

TEST(Ranges, AreAcceptedEverywhere) {
  constexpr int kPlaces = 3;
  std::size_t scenes = 0;
  for (const ShippedScene& shipped : shipped_scenes()) {
    const std::string text(shipped.text);
    const Ranges ranges = ranges_of(text);
    if (!ranges.contains("blue.position")) continue;
    ++scenes;
    EXPECT_GE(ranges.size(), 11U) << shipped.name;
    for (const auto& [key, ends] : ranges) {
      for (int place = 0; place < kPlaces; ++place) {
        double value = ends[0] + (ends[1] - ends[0]) * place / (kPlaces - 1);
        if (place == kPlaces - 1) value = ends[1];
        if (key == "digits" || key == "base") value = std::floor(value);
        const std::string setting = fmt::format("{}={}", key, value);
        try {
          EXPECT_TRUE(open_script({text, setting, "frame 0", ""}).picture);
        } catch (const std::exception& error) {
          ADD_FAILURE() << shipped.name << ' ' << setting << ": " << error.what();
        }
      }
    }
  }
  EXPECT_GE(scenes, 12U);
}

/// A scene file with one more body, where there is room for it.
std::string with_room(const OpenedScript& opened, std::size_t number) {
  const auto& scene = std::get<Scene>(opened.live->script());
  const std::optional<Body> body = body_with_room(scene);
  if (!body) return {};
  const std::string name = fmt::format("body {}.", number);
  const bool is_plane = scene.system.dimensions == 2;
  std::string position = body->position[0].get_str();
  if (is_plane) position += '\t' + body->position[1].get_str();
  return fmt::format("{0}position={1}\n{0}{2}={3}", name, position, is_plane ? "radius" : "width",
                     body->size.get_str());
}

TEST(Room, IsFreeInEveryScene) {
  int tried = 0;
  for (const ShippedScene& shipped : shipped_scenes()) {
    const std::string text(shipped.text);
    if (text.find("[[body]]") == std::string::npos) continue;
    const OpenedScript opened = open_script({text, "", "frame 0", ""});
    const auto* const scene = std::get_if<Scene>(&opened.live->script());
    if (scene == nullptr) continue;
    const std::string settings = with_room(opened, scene->system.bodies.size() + 1);
    if (settings.empty()) continue;
    ++tried;
    try {
      const OpenedScript more = open_script({text, settings, "frame 0", ""});
      EXPECT_EQ(std::get<Scene>(more.live->script()).system.bodies.size(),
                scene->system.bodies.size() + 1);
    } catch (const std::exception& error) {
      ADD_FAILURE() << shipped.name << ' ' << settings << ": " << error.what();
    }
  }
  EXPECT_GT(tried, 3);
}

TEST(Room, IsTheLargestGap) {
  const std::string line =
      "time.to = 1\nbox.x = [0, 30]\n[[body]]\nposition = 2\nwidth = 2\nvelocity = 1\n"
      "[[body]]\nposition = 20\nwidth = 2\n";
  const auto opened = open_script({line, "", "", ""});
  const std::optional<Body> body = body_with_room(std::get<Scene>(opened.live->script()));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->position[0], 11);
  EXPECT_EQ(body->size, 2);
  EXPECT_EQ(body->mass, 1);
  EXPECT_EQ(body->velocity[0], 0);
  const std::string full =
      "time.to = 1\nbox.x = [0, 4]\nview.x = [0, 4]\n"
      "[[body]]\nposition = 1\nwidth = 2\n[[body]]\nposition = 3\nwidth = 2\n";
  EXPECT_FALSE(body_with_room(std::get<Scene>(open_script({full}).live->script())));
  EXPECT_NE(choices_json(*open_script({full}).live).find("\"room\":null"), std::string::npos);
}

}  // namespace
}  // namespace piblocks::web
