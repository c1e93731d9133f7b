// Whole pictures with all that can be shown: in the frame, apart from each other, right.
#include "draw/composition.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "draw/font.hpp"
#include "support/state_after.hpp"

namespace piblocks {
namespace {

using Setting = std::pair<const char*, std::string>;

constexpr const char* kAllOverlays = "digits,masses,velocities,energy,momentum,time,ruler";
constexpr const char* kAllPanels = "velocity,position,unfolded,time,count";
constexpr const char* kLongTitle = "Counting the digits of π with two blocks and a wall";

Scene scene_with(int digits, const std::vector<Setting>& settings) {
  ScriptBuilder builder;
  builder.set("test", "digits", std::to_string(digits));
  for (const auto& [key, text] : settings) builder.set("test", key, text);
  return builder.build_scene();
}

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

struct Pictures {
  explicit Pictures(const Scene& scene)
      : log(make_collision_log(scene.system)), composition(scene, *log) {}

  DrawList at(const Rational& time, const Rational& slowdown = 1) const {
    return composition.frame({.state = log->state_at(time),
                              .time = time,
                              .slowdown = slowdown,
                              .gaps = gaps_at(*log, time)});
  }

  std::unique_ptr<CollisionLog> log;
  Composition composition;
};

struct Box {
  double left;
  double top;
  double right;
  double bottom;
  std::string what;
};

/// Of a text's capitals and figures, with what hangs below the line.
Box box_of(const TextItem& text, const Fonts& fonts) {
  return {text.origin.x, text.origin.y - 0.76 * text.size_px,
          text.origin.x + fonts.of(text.face).width_em(text.text) * text.size_px,
          text.origin.y + 0.2 * text.size_px, text.text};
}

void add_texts(const std::vector<DrawItem>& items, const Fonts& fonts, std::vector<Box>& boxes) {
  for (const DrawItem& item : items) {
    if (const auto* text = std::get_if<TextItem>(&item)) boxes.push_back(box_of(*text, fonts));
    if (const auto* plate = std::get_if<PlateItem>(&item)) {
      add_texts(plate->plate->items, fonts, boxes);
    }
  }
}

std::vector<Box> texts_of(const DrawList& list) {
  std::vector<Box> boxes;
  add_texts(list.items, Fonts(), boxes);
  return boxes;
}

bool overlap(const Box& a, const Box& b) {
  constexpr double kTouch_px = 0.5;
  return a.left < b.right - kTouch_px && b.left < a.right - kTouch_px &&
         a.top < b.bottom - kTouch_px && b.top < a.bottom - kTouch_px;
}

class CompositionSizes : public testing::TestWithParam<const char*> {};

TEST_P(CompositionSizes, NoTextLeavesTheFrameOrMeetsAnother) {
  for (const int digits : {1, 3, 20}) {
    const Pictures pictures(full_scene(digits, GetParam()));
    for (const Rational& time : {Rational(0), Rational(7, 2), Rational(5)}) {
      const DrawList list = pictures.at(time, 1000);
      const std::vector<Box> boxes = texts_of(list);
      EXPECT_GT(boxes.size(), 20U);
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Box& box = boxes[i];
        EXPECT_TRUE(box.left >= 0 && box.top >= 0 && box.right <= list.width_px &&
                    box.bottom <= list.height_px)
            << box.what << " of " << digits << " digits leaves the frame";
        for (std::size_t k = 0; k < i; ++k) {
          EXPECT_FALSE(overlap(box, boxes[k]))
              << "'" << box.what << "' and '" << boxes[k].what << "' of " << digits << " digits";
        }
      }
    }
  }
}

TEST_P(CompositionSizes, IdsRiseFromBackToFront) {
  const Pictures pictures(full_scene(3, GetParam()));
  for (const Rational& time : {Rational(0), Rational(7, 2), Rational(20)}) {
    const DrawList list = pictures.at(time, 10);
    const auto id_of = [](const DrawItem& item) {
      return std::visit([](const auto& any) { return any.id; }, item);
    };
    EXPECT_EQ(std::ranges::adjacent_find(list.items, std::ranges::greater_equal(), id_of),
              list.items.end());
  }
}

INSTANTIATE_TEST_SUITE_P(Aspects, CompositionSizes,
                         testing::Values("1280x720", "3840x2160", "1440x1080", "1080x1080",
                                         "1080x1920", "720x1280", "2560x1080"));

std::string text_of(const DrawList& list, ItemId id) {
  for (const DrawItem& item : list.items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && text->id == id) return text->text;
  }
  return {};
}

bool has_text(const DrawList& list, const std::string& wanted) {
  return std::ranges::any_of(list.items, [&](const DrawItem& item) {
    const auto* text = std::get_if<TextItem>(&item);
    return text != nullptr && text->text == wanted;
  });
}

TEST(Overlays, DigitsLightUpInTheirPlaces) {
  const Pictures pictures(scene_with(5, {{"show.overlays", "digits"}}));
  const auto lit_after = [&](const char* count) {
    const DrawList list = pictures.composition.frame({state_after(*pictures.log, Integer(count))});
    return text_of(list, ItemId::lit_count) + "|" + text_of(list, ItemId::count);
  };
  EXPECT_EQ(lit_after("3141"), "|3,141");
  EXPECT_EQ(lit_after("29999"), "|29,999");
  EXPECT_EQ(lit_after("30000"), "3|0,000");
  EXPECT_EQ(lit_after("31000"), "31|,000");
  EXPECT_EQ(lit_after("31407"), "31,4|07");
  EXPECT_EQ(lit_after("31415"), "31,415|");
}

TEST(Overlays, DigitsLightUpInTheirBase) {
  const auto lit_after = [](const char* base, int digits, int count) {
    const Pictures pictures(scene_with(digits, {{"base", base}, {"show.overlays", "digits"}}));
    const DrawList list = pictures.composition.frame({state_after(*pictures.log, count)});
    return text_of(list, ItemId::lit_count) + "|" + text_of(list, ItemId::count);
  };
  EXPECT_EQ(lit_after("2", 5, 31), "|11111");
  EXPECT_EQ(lit_after("2", 5, 49), "1100|01") << "a digit may be right too early";
  EXPECT_EQ(lit_after("2", 5, 50), "110010|");
  EXPECT_EQ(lit_after("16", 3, 0x31f), "3|1f");
  EXPECT_EQ(lit_after("16", 3, 0x324), "324|");
}

/// Letters differ in width, so a count may be wider than the last one.
TEST(Composition, CounterKeepsItsPlaceInEveryBase) {
  for (const char* base : {"2", "11", "16", "36"}) {
    const Pictures pictures(scene_with(3, {{"base", base}}));
    const auto origin_at = [&](const Integer& count) {
      const DrawList list = pictures.composition.frame({state_after(*pictures.log, count)});
      for (const DrawItem& item : list.items) {
        const auto* text = std::get_if<TextItem>(&item);
        if (text != nullptr && text->id == ItemId::count)
          return std::pair(text->origin.x, text->size_px);
      }
      return std::pair(0.0, 0.0);
    };
    const auto first = origin_at(1);
    EXPECT_GT(first.first, 0);
    const Integer& last = pictures.log->size();
    for (Integer count = 2; count <= last; count += last < 500 ? 1 : 41) {
      EXPECT_EQ(origin_at(count), first) << base << ' ' << count;
    }
  }
}

TEST(Overlays, ReadOutsSayWhatIs) {
  const Pictures pictures(
      scene_with(2, {{"show.overlays", "time,energy,momentum,masses,velocities"},
                     {"time.slow-motion", "3:4:10"}}));
  const DrawList start = pictures.at(0);
  EXPECT_TRUE(has_text(start, "t = 0.000"));
  EXPECT_TRUE(has_text(start, "Energy: red 50.0000 + blue 0.0000 = 50.0000"));
  EXPECT_TRUE(has_text(start, "Momentum: red −100.000, blue 0.000, sum −100.000"));
  EXPECT_TRUE(has_text(start, "100 kg"));
  EXPECT_TRUE(has_text(start, "−1.00"));
  EXPECT_FALSE(has_text(start, "10× slower"));
  EXPECT_TRUE(has_text(pictures.at(Rational(7, 2), 10), "10× slower"));
  // The first collision, of masses 1 and 100: blue leaves with 200/101, red with -99/101.
  const DrawList first = pictures.composition.frame({state_after(*pictures.log, 1)});
  EXPECT_TRUE(has_text(first, "Momentum: red −98.020, blue −1.980, sum −100.000"));
  EXPECT_TRUE(has_text(first, "−1.98"));
}

/// While slow motion eases in, in whole numbers that need no more room than those of the windows.
TEST(Overlays, PassingFactorsAreRounded) {
  const auto label = [](const Pictures& pictures, const Rational& slowdown) -> std::string {
    for (const Box& box : texts_of(pictures.at(0, slowdown))) {
      if (box.what.ends_with("er")) return box.what;
    }
    return "";
  };
  const auto with_windows = [](const char* windows) {
    return Pictures(scene_with(2, {{"time.slow-motion", windows}}));
  };
  const Pictures hundred = with_windows("2:3:100,3:4:7/2,5:6:1/20");
  EXPECT_EQ(label(hundred, Rational(1001, 1000)), "");
  EXPECT_EQ(label(hundred, Rational(8, 5)), "2× slower");
  EXPECT_EQ(label(hundred, Rational(7, 2)), "3.5× slower") << "a window's own factor";
  EXPECT_EQ(label(hundred, Rational(3701, 100)), "37× slower");
  EXPECT_EQ(label(hundred, Rational(999, 10)), "100× slower");
  EXPECT_EQ(label(hundred, Rational(10, 73)), "7× faster");
  EXPECT_EQ(label(hundred, Rational(1, 20)), "20× faster");
  EXPECT_EQ(label(with_windows("auto"), Rational(31415, 100)), "310× slower");
  const Font font;
  for (const char* factor : {"3/2", "2", "9.7", "10", "99.5", "1e7", "1/3", "1e-9"}) {
    const Pictures pictures = with_windows((std::string("2:3:") + factor).c_str());
    const Rational whole = parse_rational(factor);
    const double room_em = font.width_em(label(pictures, whole));
    EXPECT_GT(room_em, 0) << factor;
    for (int i = 1; i < 50; ++i) {
      const std::string text = label(pictures, 1 / (1 + (1 / whole - 1) * i / 50));
      EXPECT_LE(text.empty() ? 0 : font.width_em(text), room_em) << text << " of " << factor;
    }
  }
}

TEST(Overlays, NameNoColourThatIsNotThere) {
  std::vector<Setting> things{{"show.overlays", kAllOverlays}};
  for (const char* panel : {"velocity", "position", "unfolded", "time", "count", "ellipse",
                            "mirrors", "conservation", "certainty"}) {
    things.emplace_back("show.panels", panel);
  }
  for (const char* theme : {"print", "colorblind"}) {
    for (const char* size : {"1920x1080", "1080x1080"}) {
      for (const Setting& thing : things) {
        const Pictures pictures(scene_with(3, {{"view.size", size}, {"view.theme", theme}, thing}));
        for (const Box& box : texts_of(pictures.at(3))) {
          EXPECT_EQ(box.what.find("red"), std::string::npos) << box.what;
          EXPECT_EQ(box.what.find("blue"), std::string::npos) << box.what;
        }
      }
    }
  }
}

TEST(Overlays, ReadOutsHoldMassesBeyondADouble) {
  const Pictures pictures(scene_with(200, {{"show.overlays", "energy,momentum,masses"}}));
  const DrawList start = pictures.at(0);
  EXPECT_TRUE(has_text(start, "Energy ×10³⁹⁷: red 5.00000 + blue 0.00000 = 5.00000"));
  EXPECT_TRUE(has_text(start, "Momentum ×10³⁹⁸: red −1.00000, blue 0.00000, sum −1.00000"));
  EXPECT_TRUE(has_text(start, "10³⁹⁸ kg"));
}

/// "red 1.25 + blue 3.75 = 5" and the like: the number after a word.
double number_after(std::string text, const std::string& word) {
  std::erase(text, ',');
  return std::stod(text.substr(text.find(word) + word.size()));
}

TEST(Overlays, EnergyIsSharedAtTheTurnOfAnyMass) {
  for (const int digits : {3, 20, 163, 200, 300}) {
    const Pictures pictures(scene_with(digits, {{"show.overlays", "energy"}}));
    const std::string text = text_of(pictures.at(Rational(7, 2)), ItemId::read_outs);
    const double red = number_after(text, "red ");
    const double blue = number_after(text, "blue ");
    // About the turn blue has nearly all of it.
    EXPECT_GT(blue, red) << text;
    EXPECT_NEAR(red + blue, number_after(text, "= "), 2e-5 * (red + blue)) << text;
  }
}

TEST(Overlays, MomentumHoldsAnyMass) {
  for (const char* mass : {"1/10^310", "1/10^200", "10^310"}) {
    const Pictures pictures(
        scene_with(1, {{"show.overlays", "momentum,energy"}, {"red.mass", mass}}));
    for (const Rational& time : {Rational(0), Rational(3), Rational(9)}) {
      const DrawList list = pictures.at(time);
      for (const Box& box : texts_of(list)) {
        EXPECT_EQ(box.what.find("nan"), std::string::npos) << box.what;
        EXPECT_EQ(box.what.find("inf"), std::string::npos) << box.what;
      }
    }
    // Blue is at rest at first, and all momentum is red's: of a red so light next to nothing of
    // what blue could have with the same energy.
    const std::string red = std::string(mass).starts_with("1/") ? "0.00000" : "−1.00000";
    const std::string start = text_of(pictures.at(0), nth(ItemId::read_outs, 1));
    EXPECT_NE(start.find("red " + red + ", blue 0.00000, sum " + red), std::string::npos) << start;
  }
}

TEST(Overlays, MakeRoomForInstantsOutsideOfTheSpan) {
  const Pictures pictures(scene_with(
      3, {{"show.overlays", "time,energy"}, {"view.size", "800x450"}, {"time.to", "5"}}));
  const DrawList list = pictures.at(1000000);
  EXPECT_TRUE(has_text(list, "t = 1,000,000.00"));
  const std::vector<Box> boxes = texts_of(list);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(overlap(boxes[i], boxes[k])) << boxes[i].what << " and " << boxes[k].what;
    }
  }
}

TEST(Overlays, AreReadableInSmallFrames) {
  const Pictures pictures(
      scene_with(1, {{"show.overlays", "time,energy"}, {"view.size", "320x180"}}));
  int read_outs = 0;
  for (const DrawItem& item : pictures.at(1).items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text == nullptr || text->id < ItemId::read_outs) continue;
    ++read_outs;
    EXPECT_GE(text->size_px, 8) << text->text;
  }
  EXPECT_EQ(read_outs, 2);
}

TEST(Overlays, TimeHasTheDecimalsThatTheSpeedNeeds) {
  const std::vector<Setting> usual = {
      {"show.overlays", "time"}, {"time.from", "2.5"}, {"time.to", "3.5"}};
  const auto with = [&](const char* key, const char* text) {
    std::vector<Setting> settings = usual;
    settings.emplace_back(key, text);
    return text_of(Pictures(scene_with(3, settings)).at(Rational(5, 2)), ItemId::read_outs);
  };
  EXPECT_EQ(with("time.speed", "1/600"), "t = 2.50000");
  EXPECT_EQ(with("time.duration", "600"), "t = 2.50000");
  EXPECT_EQ(with("time.duration", "1"), "t = 2.50");
}

/// A double has no more than 17 digits, and no quarter here.
TEST(Overlays, TimeIsExactHoweverLate) {
  const Pictures pictures(scene_with(3, {{"show.overlays", "time"}}));
  const DrawList list = pictures.at(parse_rational("123456789012345678.25"));
  EXPECT_TRUE(has_text(list, "t = 123,456,789,012,345,678.25"));
}

TEST(Panels, TheUnfoldedLineStaysInItsPlace) {
  const std::vector<Setting> usual = {{"show.panels", "unfolded"}, {"view.size", "800x450"}};
  const std::vector<std::vector<Setting>> systems = {
      {{"blue.velocity", "1/2"}, {"red.mass", "1"}, {"time.from", "-10"}, {"time.to", "5"}},
      {{"blue.velocity", "-1/2"}, {"red.mass", "7"}, {"time.to", "20"}},
      {{"blue.velocity", "-3"}, {"red.velocity", "0"}, {"red.mass", "1/9"}, {"time.to", "20"}},
      {{"time.from", "-30"}, {"time.to", "30"}}};
  for (const auto& system : systems) {
    std::vector<Setting> settings = usual;
    settings.insert(settings.end(), system.begin(), system.end());
    const Pictures pictures(scene_with(1, settings));
    for (int time = -30; time <= 30; ++time) {
      const DrawList list = pictures.at(time);
      const auto plate = std::ranges::find_if(
          list.items, [](const DrawItem& item) { return std::holds_alternative<PlateItem>(item); });
      ASSERT_NE(plate, list.items.end());
      const Rectangle place = std::get<PlateItem>(*plate).bounds;
      std::vector<DrawItem> items(plate, list.items.end());
      const auto& still = std::get<PlateItem>(*plate).plate->items;
      items.insert(items.end(), still.begin(), still.end());
      for (const DrawItem& item : items) {
        const auto* path = std::get_if<PathItem>(&item);
        if (path == nullptr) continue;
        for (const Point& point : path->points.view()) {
          EXPECT_TRUE(point.x >= place.x && point.x <= place.x + place.width &&
                      point.y >= place.y && point.y <= place.y + place.height)
              << "at " << time << ": " << point.x << ", " << point.y;
        }
      }
    }
  }
}

TEST(Panels, CostLittleForAnyNumberOfDigits) {
  for (const int digits : {1, 9, 20, 100, 200, 300}) {
    for (const char* panels : {"velocity,position,unfolded", "time,count", "ellipse,mirrors",
                               "conservation,certainty"}) {
      const Pictures pictures(scene_with(digits, {{"show.panels", panels}}));
      EXPECT_LT(pictures.at(4).items.size(), 400U) << digits << ' ' << panels;
    }
  }
}

TEST(Composition, WhatIsOffIsNotThere) {
  EXPECT_EQ(Pictures(scene_with(3, {})).at(1).items.size(), 5U);
}

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

std::string problem_of(const std::vector<Setting>& settings, int digits = 3) {
  try {
    Pictures pictures(scene_with(digits, settings));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
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
  EXPECT_NE(problem_of({{"show.overlays", "digits"}, {"base", "2"}, {"mass-ratio", "32"}})
                .find("give a mass ratio of 4^(D-1) and"),
            std::string::npos);
  EXPECT_EQ(problem_of({{"show.overlays", "digits"}, {"base", "2"}, {"mass-ratio", "64"}}),
            "accepted");
  EXPECT_NE(problem_of({{"show.overlays", "digits"}, {"base", "7"}}, 2)
                .find("this scene counts 31 in base 7, and pi begins with 30"),
            std::string::npos);
}

TEST(Composition, RefusesAViewThatIsCloserThanPositionsAreKnown) {
  const auto problem_at = [](const Rational& far, const Rational& unit) {
    Scene scene = scene_with(3, {});
    scene.system.wall_face = far;
    scene.system.blue.position = far + 2 * unit;
    scene.system.red.position = far + 5 * unit;
    scene.system.blue.width = scene.system.red.width = unit;
    scene.view.x = {far - unit, far + 12 * unit};
    scene.view.y = {-unit, unit};
    try {
      Pictures pictures(scene);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(problem_at(parse_rational("1e15"), 1),
            "view.x: so far from 0 positions are 2.2e-01 apart, which would be 31.1 pixels; show "
            "more of the axis, or move wall, blocks and view towards 0");
  EXPECT_TRUE(problem_at(1, parse_rational("1e-15")).starts_with("view.x: so far from 0"));
  EXPECT_EQ(problem_at(parse_rational("1e12"), 1), "accepted");
  EXPECT_EQ(problem_at(parse_rational("1e15"), parse_rational("1e5")), "accepted");
  EXPECT_EQ(problem_at(0, parse_rational("1e-300")), "accepted");
}

}  // namespace
}  // namespace piblocks
