// The loupe covers nothing, and has room wherever there is some.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <string>

#include "draw/lecture_frames.hpp"
#include "draw/mirrored.hpp"

namespace piblocks {
namespace {

/// What the loupe must not cover: texts and blocks. Its own texts are checked against these too.
std::vector<Box> places(const DrawList& frame, const Fonts& fonts) {
  std::vector<Box> found;
  for (const DrawItem& item : frame.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) {
      found.push_back(box_of(*text, fonts));
      if (shows(text->id, ItemId::loupe)) found.back().what = "zoom";
    }
    const auto* box = std::get_if<RectangleItem>(&item);
    if (box != nullptr && shows(box->id, ItemId::red_block)) found.push_back({box->bounds, "red"});
    if (box != nullptr && shows(box->id, ItemId::blue_block)) {
      found.push_back({box->bounds, "blue"});
    }
    const auto* plate = std::get_if<PlateItem>(&item);
    if (plate != nullptr && plate->id >= ItemId::panels) {
      found.push_back({plate->bounds, "panel"});
    }
    const auto* group = std::get_if<GroupItem>(&item);
    if (group != nullptr) found.push_back({group->bounds, "loupe"});
  }
  return found;
}

void expect_apart(const DrawList& frame, const Fonts& fonts) {
  const std::vector<Box> all = places(frame, fonts);
  for (const Box& one : all) {
    if (one.what != "loupe" && one.what != "zoom") continue;
    EXPECT_TRUE(whole_of(frame).holds(one)) << one.what;
    for (const Box& other : all) {
      const bool is_inside = one.what == "zoom" && other.what == "loupe";
      if (other.what == "zoom" || other.what == one.what || is_inside) continue;
      EXPECT_FALSE(one.meets(other)) << one.what << " and " << other.what;
    }
  }
}

TEST(LoupePlace, HasRoomBesideTwoDiagrams) {
  for (const char* size : {"1920x1080", "1280x720", "1080x1920", "720x1600"}) {
    const Frames frames(lecture(5, size) +
                        Settings{{"show.title", "The turn of five digits"},
                                 {"show.overlays", "masses"},
                                 {"show.panels", "velocity,unfolded"},
                                 {"time.slow-motion", "turn-1e-6:turn+1e-6:1e7"}});
    EXPECT_TRUE(loupe_in(frames.at(frames.turn()))) << size;
  }
}

/// The lines to the inset begin behind red, or above it at 60 % of its width, and go away from the
/// gap.
/// @param side  -1: the wall is on the right
void expect_lines_clear_of_the_gap(const DrawList& frame, int side) {
  constexpr std::size_t kFirstLine = 100;
  const Rect red = items_of<RectangleItem>(frame.items, ItemId::red_block).front().bounds;
  int lines = 0;
  for (const PathItem& line : items_of<PathItem>(frame.items, ItemId::wall)) {
    if (line.id < nth(ItemId::wall, kFirstLine)) continue;
    ++lines;
    const auto points = line.points.view();
    if (std::max(points[0].y, points[1].y) <= red.y) {
      EXPECT_NEAR(points[0].x, red.x + (side > 0 ? 0.6 : 0.4) * red.width, 1);
    } else {
      EXPECT_GE(points[0].x, red.x);
      EXPECT_LE(points[0].x, red.right() + 1);
      EXPECT_TRUE(side > 0 ? points[1].x > red.right() : points[1].x < red.x);
    }
  }
  EXPECT_EQ(lines, loupe_in(frame) ? 2 : 0);
}

TEST(LoupePlace, CoversNothingInAnyShape) {
  const Fonts fonts;
  const std::vector<Settings> contents = {
      {},
      {{"show.overlays", "masses,velocities"}},
      {{"show.overlays", "masses,velocities,time,ruler"}, {"show.title", "Why do blocks count π?"}},
      {{"show.panels", "velocity,unfolded"}, {"red.width", "by-mass"}},
      {{"show.panels", "velocity"}, {"show.overlays", "masses"}, {"show.title", "Why?"}},
      {{"time.slow-motion", "auto"}, {"show.caption", "Slowly"}, {"show.overlays", "energy"}}};
  int seen = 0;
  int tried = 0;
  for (const char* size : {"1280x720", "3840x2160", "1080x1920", "1080x1080", "1600x600",
                           "720x1600", "1024x768", "640x360"}) {
    for (const auto& [digits, side] : {std::pair(2, 1), {3, 1}, {20, 1}, {2, -1}, {5, -1}}) {
      for (const char* theme : {"lecture", "article", "print"}) {
        for (const Settings& content : contents) {
          std::optional<Frames> frames;
          try {
            const Scene scene = scene_with(lecture(digits, size) + Settings{{"view.theme", theme}} +
                                           Settings{{"show.loupe", "auto"}} + content);
            frames.emplace(side > 0 ? scene : mirrored(scene));
          } catch (const UsageError&) {  // too small for something else
            continue;
          }
          SCOPED_TRACE(std::string(size) + ", digits " + std::to_string(digits) + ", " + theme +
                       (content.empty() ? "" : ", " + content.front().second));
          ++tried;
          for (const char* distance : {"-0.7", "-0.4", "-0.1", "0", "0.01", "0.3", "0.6"}) {
            const DrawList frame = frames->at(frames->turn() + parse_rational(distance));
            seen += loupe_in(frame) ? 1 : 0;
            expect_apart(frame, fonts);
            expect_lines_clear_of_the_gap(frame, side);
          }
        }
      }
    }
  }
  EXPECT_GT(tried, 250);
  EXPECT_GT(seen, 4 * tried);
}

/// Across most of the frame, with its right edge on the margin, above blocks that are a low strip.
TEST(LoupePlace, OfAStageIsAboveLowBlocks) {
  const Fonts fonts;
  const Settings contents = {{"show.title", "The turn"}, {"show.overlays", "digits,masses"}};
  for (const auto& [size, width] : {std::pair("1280x720", 0.7 * 1280),
                                    {"1024x768", 0.7 * 1024},
                                    {"1080x1080", 0.88 * 1080},
                                    {"1080x1350", 0.88 * 1080},
                                    {"1080x1920", 0.88 * 1080}}) {
    for (const int side : {1, -1}) {
      SCOPED_TRACE(std::string(size) + ", side " + std::to_string(side));
      const Scene scene = scene_with(
          lecture(5, size) + contents +
          Settings{{"show.loupe", "stage"}, {"time.slow-motion", "turn-1e-4:turn+1e-4:1e4"}});
      const Frames frames(side > 0 ? scene : mirrored(scene));
      const DrawList frame = frames.at(frames.turn());
      const auto seen = loupe_in(frame);
      ASSERT_TRUE(seen);
      const double margin = 0.06 * std::min(frame.width_px, frame.height_px);
      EXPECT_NEAR(seen->bounds.width, width, 1.5);
      const double away = side > 0 ? frame.width_px - seen->bounds.right() : seen->bounds.x;
      EXPECT_NEAR(away, margin, 1.5);
      EXPECT_GE(seen->bounds.y, 0.25 * frame.height_px);
      const Rect red = items_of<RectangleItem>(frame.items, ItemId::red_block).front().bounds;
      EXPECT_LE(red.height, 0.2 * std::min(frame.width_px, frame.height_px));
      EXPECT_LT(seen->bounds.bottom(), red.y);
      EXPECT_LE(red.bottom(), frame.height_px - margin);
      expect_apart(frame, fonts);
      expect_lines_clear_of_the_gap(frame, side);
    }
  }
}

TEST(LoupePlace, OfAStageNeedsRoom) {
  EXPECT_THROW(Frames(lecture(5) + Settings{{"show.loupe", "stage"}, {"show.panels", "velocity"}}),
               UsageError);
  // Equal masses do not come near the wall.
  EXPECT_THROW(Frames(lecture(1) + Settings{{"show.loupe", "stage"}}), UsageError);
}

TEST(LoupePlace, OfOtherBlocksCoversNothing) {
  const Fonts fonts;
  int seen = 0;
  for (const char* size : {"1280x720", "3840x2160", "1080x1920", "1080x1080", "640x360"}) {
    for (const char* overlays : {"time", "masses,velocities", "ruler,energy"}) {
      for (const int side : {1, -1}) {
        SCOPED_TRACE(std::string(size) + ", " + overlays);
        Scene scene = scene_with({{"view.size", size},
                                  {"view.theme", "dark"},
                                  {"show.title", "Three"},
                                  {"show.overlays", overlays}});
        scene.system = {1,
                        {{1, {2 * side}, {side}}, {5, {6 * side}}, {std::nullopt, {9 * side}}},
                        {{"wall", {side > 0 ? 0 : 12}, {1}}}};
        if (side < 0) scene.system.walls[0].point = {-12};
        scene.styles.resize(3);
        scene.view.x = side > 0 ? Range{0, 12} : Range{-12, 0};
        scene.time.to = Instant(Rational(8));
        scene.show.loupe =
            Loupe{.window = LoupeWindow{Instant(Rational(2)), Instant(Rational(5)), 20}};
        std::optional<Frames> frames;
        try {
          frames.emplace(scene);
        } catch (const UsageError&) {  // too small
          continue;
        }
        const DrawList frame = frames->at(Rational(601, 200));
        seen += loupe_in(frame) ? 1 : 0;
        expect_apart(frame, fonts);
      }
    }
  }
  EXPECT_GT(seen, 15);
}

}  // namespace
}  // namespace piblocks
