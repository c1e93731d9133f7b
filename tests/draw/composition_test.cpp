// Whole pictures with all that can be shown: in the frame, apart from each other, right.
#include "draw/composition.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <string>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"

namespace piblocks {
namespace {
using testing_support::contains;
using testing_support::message_of;

constexpr const char* kAllPanels = "velocity,position,unfolded,time,count";
constexpr const char* kLongTitle = "Counting the digits of π with two blocks and a wall";

/// All that has room together.
Scene full_scene(int digits, const std::string& size, const std::string& theme = "article") {
  return scene_with(digits, {{"view.size", size},
                             {"view.theme", theme},
                             {"show.overlays", "digits,masses,velocities,time"},
                             {"show.panels", "velocity,unfolded"},
                             {"show.title", kLongTitle},
                             {"show.caption", "Wall, blue, red"},
                             {"time.slow-motion", "auto"}});
}

class CompositionSizes : public testing::TestWithParam<const char*> {};

TEST_P(CompositionSizes, NoTextLeavesTheFrameOrMeetsAnother) {
  for (const int digits : {1, 3, 20}) {
    const Pictures pictures(full_scene(digits, GetParam()));
    for (const Rational& time : {Rational(0), Rational(7, 2), Rational(5)}) {
      const DrawList list = pictures.at(time, 1000);
      const std::vector<Box> boxes = boxes_of(list);
      EXPECT_GT(boxes.size(), 20U);
      EXPECT_EQ(text_problem(boxes, whole_of(list)), "") << digits << " digits";
    }
  }
}

TEST_P(CompositionSizes, IdsRiseFromBackToFront) {
  const Pictures pictures(full_scene(3, GetParam()));
  for (const Rational& time : {Rational(0), Rational(7, 2), Rational(20)}) {
    EXPECT_TRUE(have_rising_ids(pictures.at(time, 10)));
  }
}

INSTANTIATE_TEST_SUITE_P(Aspects, CompositionSizes,
                         testing::Values("1280x720", "3840x2160", "1440x1080", "1080x1080",
                                         "1080x1920", "720x1280", "2560x1080"));

/// Letters differ in width, so a count may be wider than the last one.
TEST(Composition, CounterKeepsItsPlaceInEveryBase) {
  for (const char* base : {"2", "11", "16", "36"}) {
    const Pictures pictures(3, {{"base", base}});
    const auto origin_at = [&](const Integer& count) {
      const DrawList list = pictures.after(count);
      const auto& text = item_of<TextItem>(list, ItemId::count);
      return std::pair(text.origin.x, text.size_px);
    };
    const auto first = origin_at(1);
    EXPECT_GT(first.first, 0);
    const Integer& last = pictures.log->last();
    for (Integer count = 2; count <= last; count += last < 500 ? 1 : 41) {
      EXPECT_EQ(origin_at(count), first) << base << ' ' << count;
    }
  }
}

TEST(Panels, TheUnfoldedLineStaysInItsPlace) {
  const std::vector<Settings> systems = {
      {{"blue.velocity", "1/2"}, {"red.mass", "1"}, {"time.from", "-10"}, {"time.to", "5"}},
      {{"blue.velocity", "-1/2"}, {"red.mass", "7"}, {"time.to", "20"}},
      {{"blue.velocity", "-3"}, {"red.velocity", "0"}, {"red.mass", "1/9"}, {"time.to", "20"}},
      {{"time.from", "-30"}, {"time.to", "30"}}};
  for (const Settings& system : systems) {
    const Pictures pictures(
        1, Settings{{"show.panels", "unfolded"}, {"view.size", "800x450"}} + system);
    for (int time = -30; time <= 30; ++time) {
      const Shown shown(pictures.at(time));
      ASSERT_FALSE(shown.plates.empty());
      for (const PathItem& path : shown.paths) {
        EXPECT_TRUE(shown.plates.front().bounds.holds(path.points.bounds())) << "at " << time;
      }
    }
  }
}

TEST(Panels, CostLittleForAnyNumberOfDigits) {
  for (const int digits : {1, 9, 20, 100, 200, 300}) {
    for (const char* panels : {"velocity,position,unfolded", "time,count", "ellipse,mirrors",
                               "conservation,certainty"}) {
      const Pictures pictures(digits, {{"show.panels", panels}});
      EXPECT_LT(pictures.at(4).items.size(), 400U) << digits << ' ' << panels;
    }
  }
}

TEST(Composition, WhatIsOffIsNotThere) { EXPECT_EQ(Pictures(3, {}).at(1).items.size(), 5U); }

/// Scenes of other programs may not have been checked.
TEST(Composition, RefusesLinesThatAreNotUtf8) {
  for (const char* theme : {"article", "lecture"}) {
    for (std::string Show::*const line : {&Show::title, &Show::caption}) {
      Scene scene = scene_with(3, {{"view.theme", theme}});
      scene.show.*line =
          "a\xff"
          "b";
      EXPECT_THROW(Pictures{scene}, UsageError) << theme;
    }
  }
}

/// Texts of a frame, and where the blocks are.
std::string described(const Scene& scene) {
  std::string text;
  for (const DrawItem& item : Pictures(scene).at(1).items) {
    if (const auto* line = std::get_if<TextItem>(&item)) {
      text += fmt::format("{} {} {}\n", line->text, line->origin.x, line->origin.y);
    }
    if (const auto* block = std::get_if<RectangleItem>(&item)) {
      text += fmt::format("{} {}\n", block->bounds.x, block->bounds.y);
    }
  }
  return text;
}

TEST(Composition, SetsLinesWithSingleBlanks) {
  const auto shown = [](const Setting& theme, const Setting& line, bool is_row) {
    Scene scene = scene_with(3, {theme, line});
    if (is_row) {
      scene.view.short_side_px = 720;
      scene.view.height_px = 240;
    }
    return described(scene);
  };
  for (const char* theme : {"article", "lecture"}) {
    for (const char* key : {"show.title", "show.caption"}) {
      const std::string wide =
          "The collisions of two blocks and a wall count all of the digits of π";
      for (const std::string& line : {std::string("fi fi"), std::string(), wide}) {
        const bool is_row = theme == std::string("lecture") && key == std::string("show.title");
        std::string spaced = " ";
        for (const char c : line) spaced += c == ' ' ? std::string("   ") : std::string(1, c);
        for (const bool row : {false, is_row && line.size() < 10}) {
          EXPECT_EQ(shown({"view.theme", theme}, {key, spaced + ' '}, row),
                    shown({"view.theme", theme}, {key, line}, row))
              << theme << ' ' << key << ' ' << line;
        }
      }
    }
  }
}

std::string problem_of(const Settings& settings, int digits = 3) {
  return message_of<UsageError>([&] { Pictures(digits, settings); });
}

TEST(Composition, SaysWhyItCannotBeShown) {
  EXPECT_EQ(problem_of({{"show.title", "Zahlen 数"}}),
            "show.title: no embedded font has a glyph for '数'; write it in other characters");
  EXPECT_EQ(problem_of({{"show.caption", "\xff\xfe"}}),
            "test: show.caption is not valid UTF-8; write it in that encoding");
  EXPECT_TRUE(problem_of({{"show.title", std::string(200, 'w')}}).starts_with("show.title: 'www"));
  EXPECT_EQ(problem_of({{"show.panels", kAllPanels}, {"view.size", "200x180"}}),
            "show.panels: 5 diagrams do not fit into 200x180; leave some out, or make the frame "
            "larger");
  EXPECT_TRUE(problem_of({{"show.panels", kAllPanels}, {"view.size", "320x180"}})
                  .starts_with("show.panels: the title of the diagram 'velocity' needs"));
  EXPECT_TRUE(problem_of({{"show.panels", "mirrors,unfolded,time"}, {"view.size", "190x160"}})
                  .starts_with("show.panels: the title of the diagram 'mirrors' needs"));
  EXPECT_TRUE(problem_of({{"show.panels", "unfolded,mirrors,time"}, {"view.size", "190x160"}})
                  .starts_with("show.panels: the title of the diagram 'unfolded' needs"));
  EXPECT_TRUE(problem_of({{"show.overlays", "velocities"}, {"view.size", "60x300"}})
                  .starts_with("show.overlays: the velocities need"));
  EXPECT_TRUE(problem_of({{"show.overlays", "ruler"}, {"view.size", "160x20"}})
                  .starts_with("show.overlays: the ruler needs"));
  EXPECT_TRUE(problem_of({{"show.overlays", "digits"}, {"blue.velocity", "1/7"}})
                  .starts_with("show.overlays: there are no digits of pi"));
  EXPECT_TRUE(
      contains(problem_of({{"show.overlays", "digits"}, {"base", "2"}, {"mass-ratio", "32"}}),
               "give a mass ratio of 4^(D-1) and"));
  EXPECT_EQ(problem_of({{"show.overlays", "digits"}, {"base", "2"}, {"mass-ratio", "64"}}), "");
  EXPECT_TRUE(contains(problem_of({{"show.overlays", "digits"}, {"base", "7"}}, 2),
                       "this scene counts 31 in base 7, and pi begins with 30"));
}

TEST(Composition, RefusesAViewThatIsCloserThanPositionsAreKnown) {
  const auto problem_at = [](const Rational& far, const Rational& unit) {
    Scene scene = scene_with(3, {});
    scene.system.walls[0].point[0] = far;
    scene.system.bodies[0].position[0] = far + 2 * unit;
    scene.system.bodies[1].position[0] = far + 5 * unit;
    scene.system.bodies[0].size = scene.system.bodies[1].size = unit;
    scene.view.x = {far - unit, far + 12 * unit};
    scene.view.y = {-unit, unit};
    return message_of<UsageError>([&] { Pictures{scene}; });
  };
  EXPECT_EQ(problem_at(parse_rational("1e15"), 1),
            "view.x: so far from 0 positions are 2.2e-01 apart, which would be 31.1 pixels; show "
            "more of the axis, or move walls, bodies and view towards 0");
  EXPECT_TRUE(problem_at(1, parse_rational("1e-15")).starts_with("view.x: so far from 0"));
  EXPECT_EQ(problem_at(parse_rational("1e12"), 1), "");
  EXPECT_EQ(problem_at(parse_rational("1e15"), parse_rational("1e5")), "");
  EXPECT_EQ(problem_at(0, parse_rational("1e-300")), "");
}

}  // namespace
}  // namespace piblocks
