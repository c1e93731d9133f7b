// Whole pictures with all that can be shown: in the frame, apart from each other, right.
#include <gtest/gtest.h>
#include <piblocks/composition.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "draw/font.hpp"

namespace piblocks {
namespace {

using Setting = std::pair<const char*, std::string>;

constexpr const char* kAllOverlays = "digits,masses,velocities,energy,momentum,time,ruler";
constexpr const char* kAllPanels = "velocity,position,unfolded,time,rate";
constexpr const char* kLongTitle = "Counting the digits of π with two blocks and a wall";

Scene scene_with(int digits, const std::vector<Setting>& settings) {
  SceneBuilder builder;
  builder.set_mass_ratio("test", power(100, static_cast<unsigned long>(digits - 1)));
  for (const auto& [key, text] : settings) builder.set("test", key, text);
  return builder.build();
}

Scene full_scene(int digits, const std::string& size, const std::string& theme = "article") {
  return scene_with(digits, {{"view.size", size},
                             {"view.theme", theme},
                             {"show.overlays", kAllOverlays},
                             {"show.panels", kAllPanels},
                             {"show.title", kLongTitle},
                             {"show.caption", "Wall, blue, red"},
                             {"time.slow-motion", "auto"}});
}

struct Pictures {
  explicit Pictures(const Scene& scene)
      : log(make_collision_log(scene.system)), composition(scene, *log) {}

  DrawList at(const Rational& time, const Rational& slower = 1) const {
    return composition.frame({state_at(*log, time), time, slower});
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
Box box_of(const TextItem& text, const Font& font) {
  return {text.origin.x, text.origin.y - 0.76 * text.size_px,
          text.origin.x + font.width_em(text.text) * text.size_px,
          text.origin.y + 0.2 * text.size_px, text.text};
}

void add_texts(const std::vector<DrawItem>& items, const Font& font, std::vector<Box>& boxes) {
  for (const DrawItem& item : items) {
    if (const auto* text = std::get_if<TextItem>(&item)) boxes.push_back(box_of(*text, font));
    if (const auto* plate = std::get_if<PlateItem>(&item)) {
      add_texts(plate->plate->items, font, boxes);
    }
  }
}

std::vector<Box> texts_of(const DrawList& list) {
  std::vector<Box> boxes;
  add_texts(list.items, Font(), boxes);
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
          // Figures above two blocks may meet while these do.
          if (box.what.find('.') != std::string::npos &&
              boxes[k].what.find('.') != std::string::npos && box.top == boxes[k].top) {
            continue;
          }
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

TEST(Overlays, ReadOutsSayWhatIs) {
  const Pictures pictures(
      scene_with(2, {{"show.overlays", "time,energy,momentum,masses,velocities"},
                     {"time.slow-motion", "3:4:10"}}));
  const DrawList start = pictures.at(0);
  EXPECT_TRUE(has_text(start, "t = 0.000"));
  EXPECT_TRUE(has_text(start, "Energy: red 50.0000 + blue 0.0000 = 50.0000"));
  EXPECT_TRUE(has_text(start, "Momentum: red −100.000, blue 0.000, sum −100.000"));
  EXPECT_TRUE(has_text(start, "100"));
  EXPECT_TRUE(has_text(start, "−1.00"));
  EXPECT_FALSE(has_text(start, "10× slower"));
  EXPECT_TRUE(has_text(pictures.at(Rational(7, 2), 10), "10× slower"));
  // The first collision, of masses 1 and 100: blue leaves with 200/101, red with -99/101.
  const DrawList first = pictures.composition.frame({state_after(*pictures.log, 1)});
  EXPECT_TRUE(has_text(first, "Momentum: red −98.020, blue −1.980, sum −100.000"));
  EXPECT_TRUE(has_text(first, "−1.98"));
}

TEST(Overlays, ReadOutsHoldMassesBeyondADouble) {
  const Pictures pictures(scene_with(200, {{"show.overlays", "energy,momentum,masses"}}));
  const DrawList start = pictures.at(0);
  EXPECT_TRUE(has_text(start, "Energy ×10³⁹⁷: red 5.00000 + blue 0.00000 = 5.00000"));
  EXPECT_TRUE(has_text(start, "Momentum ×10³⁹⁸: red −1.00000, blue 0.00000, sum −1.00000"));
  EXPECT_TRUE(has_text(start, "10³⁹⁸"));
}

TEST(Panels, CostLittleForAnyNumberOfDigits) {
  for (const int digits : {1, 9, 20, 100}) {
    const Pictures pictures(scene_with(digits, {{"show.panels", kAllPanels}}));
    EXPECT_LT(pictures.at(4).items.size(), 600U) << digits;
  }
}

TEST(Composition, WhatIsOffIsNotThere) {
  EXPECT_EQ(Pictures(scene_with(3, {})).at(1).items.size(), 5U);
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
            "show.title: the font DejaVu Sans has no glyph for '数'");
  EXPECT_EQ(problem_of({{"show.caption", "\xff\xfe"}}), "show.caption: is not valid UTF-8");
  EXPECT_TRUE(problem_of({{"show.title", std::string(200, 'w')}}).starts_with("show.title: 'www"));
  EXPECT_EQ(problem_of({{"show.panels", kAllPanels}, {"view.size", "320x180"}}),
            "show.panels: 5 of them do not fit into 320x180; leave some out, or make the frame "
            "larger");
  EXPECT_TRUE(problem_of({{"show.overlays", "velocities"}, {"view.size", "160x90"}})
                  .starts_with("show.overlays: the velocities need"));
  EXPECT_TRUE(problem_of({{"show.overlays", "ruler"}, {"view.size", "160x90"}})
                  .starts_with("show.overlays: the ruler needs"));
  EXPECT_TRUE(problem_of({{"show.overlays", "digits"}, {"blue.velocity", "1/7"}})
                  .starts_with("show.overlays: there are no digits of pi"));
}

}  // namespace
}  // namespace piblocks
