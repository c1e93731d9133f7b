// The loupe shows the gaps where they are, at any number of digits, and covers nothing.
#include "draw/overlays/loupe.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "draw/canvas.hpp"
#include "draw/font.hpp"
#include "draw/lecture_frames.hpp"
#include "support/oracle.hpp"
#include "support/property.hpp"

namespace piblocks {
namespace {

Settings lecture(int digits, const char* size = "1280x720") {
  return {{"digits", std::to_string(digits)}, {"view.theme", "lecture"}, {"view.size", size}};
}

Settings operator+(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

double pixels_per_unit(const DrawList& frame, const Scene& scene) {
  const auto blue = items_of<RectangleItem>(frame.items, ItemId::blue_block).front();
  return blue.bounds.width / to_double(scene.system.bodies[0].size);
}

struct ExactGaps {
  Rational y1;
  Rational y2;
};

ExactGaps exact_gaps(const TwoBlocks& system, const Rational& time) {
  const auto state = oracle::high_precision_state(system, time, 1024);
  return {
      state.blue.position - system.blue.width / 2 - system.wall_face,
      state.red.position - system.wall_face - system.blue.width - system.red.width / 2,
  };
}

void expect_exact(const Frames& frames, const Rational& time, int& plateaus) {
  const DrawList frame = frames.at(time);
  const auto seen = loupe_in(frame);
  ASSERT_TRUE(seen) << to_double(time);
  const ExactGaps gaps = exact_gaps(*two_blocks_of(frames.scene().system), time);
  const double tolerance = 1e-9 * seen->bounds.width;
  const double blue_gap = seen->blue.x - seen->face;
  const double red_gap = seen->red.x - seen->face - seen->blue.width;
  EXPECT_NEAR(blue_gap, red_gap * to_double(gaps.y1 / gaps.y2), tolerance);
  const std::string& zoom = seen->zoom;
  for (const auto& [text, factor] : {std::pair("×10", 10), {"×100", 100}, {"×1,000", 1000}}) {
    // What is rounded to it is not it.
    const double expected = to_double(gaps.y2) * pixels_per_unit(frame, frames.scene()) * factor;
    if (zoom != text || std::fabs(red_gap / expected - 1) > 1e-6) continue;
    EXPECT_NEAR(red_gap, expected, tolerance);
    ++plateaus;
  }
}

TEST(Loupe, ShowsTheGapsWhereTheyAre) {
  Random random(202611);
  SCOPED_TRACE(random.trace());
  for (const int digits : {3, 5, 20}) {
    SCOPED_TRACE(digits);
    const Frames frames(lecture(digits));
    int plateaus = 0;
    expect_exact(frames, frames.turn(), plateaus);
    for (std::int64_t i = 0; i < many(60); ++i) {
      const auto scale = static_cast<unsigned long>(random.integer(1, 7L * digits));
      const Rational distance = Rational(random.uniform(-0.5, 0.5)) / power(2, scale);
      expect_exact(frames, frames.turn() + distance, plateaus);
    }
    for (const char* near : {"0.01", "-0.02", "0.06", "-0.1", "0.15"}) {
      expect_exact(frames, frames.turn() + parse_rational(near), plateaus);
    }
    EXPECT_GT(plateaus, 3);
  }
}

TEST(Loupe, SaysPowersOfTenAtTheTurn) {
  const auto power_at_turn = [](int digits) {
    const Frames frames(lecture(digits));
    const DrawList frame = frames.at(frames.turn());
    std::string text;
    for (const auto& item : items_of<TextItem>(frame.items, ItemId::loupe)) text += item.text;
    return text;
  };
  EXPECT_EQ(power_at_turn(3), "×100");
  EXPECT_EQ(power_at_turn(4), "×1,000");
  EXPECT_EQ(power_at_turn(5), "×104");  // the exponent is raised
  EXPECT_EQ(power_at_turn(20), "×1019");
}

TEST(Loupe, KeepsRedsFaceInside) {
  for (const char* size : {"1280x720", "1080x1920", "800x800"}) {
    for (const int digits : {2, 3, 5, 8, 20}) {
      SCOPED_TRACE(std::string(size) + ", digits " + std::to_string(digits));
      const Frames frames(lecture(digits, size));
      int seen_times = 0;
      for (double y2 = 1; y2 > std::pow(10.0, -digits); y2 *= 0.97) {
        FrameState state = frames.state({frames.turn()});
        state.gaps = {y2 / 3, y2};
        const auto seen = loupe_in(frames.of(state));
        if (!seen) continue;
        ++seen_times;
        EXPECT_GT(seen->red.x, seen->face + seen->blue.width);
        EXPECT_LT(seen->red.x, seen->bounds.width - 0.03 * 720);
        EXPECT_GT(seen->red.right(), seen->bounds.width);
      }
      EXPECT_GT(seen_times, 20);
    }
  }
}

TEST(Loupe, FadesWithTheGap) {
  const Frames frames(lecture(3));
  double before = 0;
  bool was_half_seen = false;
  for (double y2 = 2; y2 > 1e-3; y2 *= 0.99) {
    FrameState state = frames.state({frames.turn()});
    state.gaps = {0, y2};
    const DrawList frame = frames.of(state);
    const auto seen = loupe_in(frame);
    const double gap_px = y2 * pixels_per_unit(frame, frames.scene());
    const double opacity = seen ? seen->opacity : 0;
    EXPECT_EQ(opacity > 0, gap_px < 72) << gap_px;
    EXPECT_GE(opacity, before);
    EXPECT_LE(opacity, before + 0.03);
    was_half_seen |= opacity > 0.4 && opacity < 0.6;
    before = opacity;
  }
  EXPECT_EQ(before, 1);
  EXPECT_TRUE(was_half_seen);
}

TEST(Loupe, IsOnlyWhereItIsAskedFor) {
  const Settings dark = {{"digits", "3"}, {"view.theme", "dark"}};
  const Frames plain(dark);
  const Frames off(dark + Settings{{"show.loupe", "off"}});
  const Frames asked(dark + Settings{{"show.loupe", "auto"}});
  const Frames article(Settings{{"show.loupe", "auto"}});
  const Frames lecture_off(lecture(3) + Settings{{"show.loupe", "off"}});
  EXPECT_EQ(draw_pixels(plain.at(plain.turn())).words, draw_pixels(off.at(off.turn())).words);
  EXPECT_FALSE(loupe_in(plain.at(plain.turn())));
  EXPECT_FALSE(loupe_in(lecture_off.at(plain.turn())));
  EXPECT_TRUE(loupe_in(asked.at(asked.turn())));
  EXPECT_TRUE(loupe_in(article.at(article.turn())));
  // Gaps cost time and are found out only where they are shown.
  EXPECT_EQ(off.state({off.turn()}).gaps.y2, 0);
  EXPECT_GT(asked.state({asked.turn()}).gaps.y2, 0);
  // Equal masses never come near each other.
  EXPECT_EQ(Frames(lecture(1)).state({Rational(3)}).gaps.y2, 0);
}

TEST(Loupe, OfAWindowHasItsZoomAndIsNotSeenOutside) {
  const Frames frames(lecture(4) + Settings{{"show.loupe", "turn-0.01:turn+0.01:50"}});
  const auto zoom_at = [&](const char* distance) {
    const auto seen = loupe_in(frames.at(frames.turn() + parse_rational(distance)));
    return seen ? seen->zoom : std::string();
  };
  EXPECT_EQ(zoom_at("0"), "×50");
  EXPECT_EQ(zoom_at("0.009"), "×50");
  EXPECT_EQ(zoom_at("0.0101"), "");
  EXPECT_EQ(zoom_at("-0.0101"), "");
  const auto edge = loupe_in(frames.at(frames.turn() - parse_rational("0.0099")));
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->opacity, 0.05, 1e-9);
  // Red stays in sight.
  const Frames large(lecture(4) + Settings{{"show.loupe", "turn-0.1:turn+0.1:10^9"}});
  const auto turn = loupe_in(large.at(large.turn()));
  ASSERT_TRUE(turn);
  EXPECT_LT(turn->red.x, turn->bounds.width);
}

/// The same bodies with their wall on the right.
Scene turned_round(Scene scene) {
  for (Body& body : scene.system.bodies) {
    body.name.clear();
    body.position[0] *= -1;
    body.velocity[0] *= -1;
  }
  Wall& wall = scene.system.walls[0];
  wall = {"right", {-wall.point[0]}, {-1}};
  scene.view.x = {-scene.view.x.high, -scene.view.x.low};
  return scene;
}

TEST(Loupe, OfAWallOnTheRightIsTurnedRound) {
  for (const int digits : {2, 5}) {
    const Scene scene = scene_with(lecture(digits));
    const Frames frames(scene);
    const Frames turned(turned_round(scene));
    for (const char* distance : {"-0.4", "-0.01", "0", "0.003", "0.2"}) {
      SCOPED_TRACE(distance);
      const Rational time = frames.turn() + parse_rational(distance);
      const auto seen = loupe_in(frames.at(time));
      const auto other = loupe_in(turned.at(time));
      ASSERT_EQ(bool(seen), bool(other));
      if (!seen) continue;
      const double width = seen->bounds.width;
      EXPECT_EQ(other->opacity, seen->opacity);
      EXPECT_EQ(other->zoom, seen->zoom);
      EXPECT_EQ(other->face, width - seen->face);
      EXPECT_NEAR(other->blue.right(), width - seen->blue.x, 1e-9);
      EXPECT_NEAR(other->red.right(), width - seen->red.x, 1e-9);
      EXPECT_EQ(other->blue.height, seen->blue.height);
      EXPECT_EQ(other->red.height, seen->red.height);
    }
  }
}

/// Blocks of width 1 between two walls, or without.
Scene row_of_blocks(Random& random, bool has_walls) {
  Scene scene = scene_with({{"view.size", "1280x720"}, {"view.theme", "dark"}});
  scene.system = {1, {}, {}};
  Rational position = 1;
  for (long body = random.integer(3, 5); body > 0; --body) {
    position += Rational(random.integer(101, 300), 100);
    scene.system.bodies.push_back(
        {Rational(random.integer(1, 9)), {position}, {Rational(random.integer(-99, 99), 50)}});
  }
  scene.styles.resize(scene.system.bodies.size());
  if (has_walls) scene.system.walls = {{"left", {0}, {1}}, {"right", {position + 1}, {-1}}};
  scene.view.x = {has_walls ? Rational(0) : Rational(-1), position + Rational(has_walls ? 1 : 3)};
  scene.time.to = Instant(Rational(3));
  return scene;
}

/// What the loupe shows of the gap that closes at a collision, beside it.
void expect_enlarged(const Scene& plain, const Collision& met, int& seen_times) {
  constexpr int kZoom = 20;
  Scene scene = plain;
  const Rational time = to_rational(met.time);
  const Rational from = time - Rational(1, 1'000'000);
  scene.show.loupe =
      Loupe{.window = LoupeWindow{Instant(from), Instant(time + Rational(1, 10)), Rational(kZoom)}};
  const Frames frames(scene);
  const DrawList frame = frames.at(time + Rational(1, 200));
  const auto seen = loupe_in(frame);
  ASSERT_TRUE(seen);
  if (seen->zoom != "×20") return;  // the gap is too wide for it
  ++seen_times;
  const State state = frames.log().state_at(time + Rational(1, 200));
  const double scale = pixels_per_unit(frame, scene);
  const bool is_wall = met.second >= scene.system.bodies.size();
  const double first = state.bodies[met.first].position[0];
  const double second =
      is_wall ? met.second_after.position[0] : state.bodies[met.second].position[0];
  const double gap = std::fabs(second - first) - (is_wall ? 0.5 : 1);
  const bool is_anchor_left = is_wall ? second < first : true;
  const double edge = is_wall ? seen->face : seen->blue.right();
  const double shown = is_anchor_left ? seen->red.x - edge : edge - seen->red.right();
  EXPECT_NEAR(shown, gap * scale * kZoom, 1e-6);
}

TEST(Loupe, EnlargesAnyGapThatClosesInItsWindow) {
  Random random(3411);
  SCOPED_TRACE(random.trace());
  int seen_times = 0;
  for (std::int64_t i = 0; i < many(60); ++i) {
    const Scene scene = row_of_blocks(random, i % 2 == 0);
    const auto log = make_log(scene.system);
    for (Integer k = 1; k <= log->count_at(Rational(2)); ++k) {
      const Collision met = log->collision(k);
      const double x = met.first_after.position[0];
      // At either side.
      const bool is_seen = x - 0.5 > to_double(scene.view.x.low) - 1e-9 &&
                           x + 0.5 < to_double(scene.view.x.high) + 1e-9;
      // Others within the window would be first, or change the gap.
      const bool is_alone = log->count_at(to_rational(met.time) - Rational(1, 1000)) == k - 1 &&
                            log->count_at(to_rational(met.time) + Rational(1, 40)) == k;
      if (is_seen && is_alone) expect_enlarged(scene, met, seen_times);
    }
  }
  EXPECT_GT(seen_times, 20);
}

std::string refusal_of(const Settings& settings) {
  try {
    const Frames frames(settings);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Loupe, SaysWhyItCannotBeShown) {
  const Settings window = {{"show.loupe", "turn-1:turn+1:10"}};
  EXPECT_NE(refusal_of(lecture(3, "200x150") + window).find("show.loupe: there is no room"),
            std::string::npos);
  EXPECT_EQ(refusal_of(lecture(3, "200x150")), "");
  Scene away = scene_with(lecture(3) + window);
  away.view.x = {1, 12};
  EXPECT_THROW(Frames{away}, UsageError);
  EXPECT_NE(refusal_of(lecture(3) + Settings{{"show.loupe", "last:#1:10"}}).find("show.loupe"),
            std::string::npos);
  for (const char* wrong :
       {"on", "turn:last", "turn:last:1", "3:2:10", "turn:last:ten", "1:2:3:4"}) {
    EXPECT_NE(refusal_of(lecture(3) + Settings{{"show.loupe", wrong}}).find("show.loupe"),
              std::string::npos)
        << wrong;
  }
}

TEST(Loupe, IsRefusedWhereItIsNeverSeen) {
  const auto expect = [](int digits, const char* window, const char* message) {
    const std::string refusal = refusal_of(lecture(digits) + Settings{{"show.loupe", window}});
    EXPECT_NE(refusal.find(message), std::string::npos) << window << ": " << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
  };
  expect(1, "turn-0.3:turn+0.3:10",
         "show.loupe: in its window from 16/5 to 19/5 the gap between wall and red is never below");
  expect(3, "turn+2:turn+3:10", "the loupe is seen below 72; move the window to the turn");
  expect(3, "turn-3:turn-2:10", "is never below");
  expect(1, "100:101:10",
         "show.loupe: its window from 100 to 101 is outside of what is shown, 0 to");
  expect(3, "-2:-1:10", "is outside of what is shown");
  // It is seen at one end alone, or before and after what is shown too.
  for (const char* window : {"turn+0.2:turn+1:10", "turn-1:turn-0.2:10", "-5:100:10"}) {
    EXPECT_EQ(refusal_of(lecture(3) + Settings{{"show.loupe", window}}), "") << window;
  }
  // A light red is nearest at a collision beside the turn.
  EXPECT_EQ(refusal_of({{"view.theme", "lecture"},
                        {"mass-ratio", "1/400"},
                        {"blue.position", "0.55"},
                        {"show.loupe", "turn-1:turn+1:10"}}),
            "");
}

TEST(Loupe, ShowsTheWayThatBlueSweepsWhereFramesMissItsHits) {
  const Frames frames(lecture(3));
  FrameState state = frames.state({frames.turn()});
  int before = 0;
  for (double rate = 10; rate < 1e6; rate *= 1.1) {
    state.hits_per_s = rate;
    const auto seen = loupe_in(frames.of(state));
    const auto blue = items_of<RectangleItem>(seen->list.items, ItemId::blue_block).front();
    const auto red = items_of<RectangleItem>(seen->list.items, ItemId::red_block);
    const auto bodies = std::ranges::count(red, seen->red, &RectangleItem::bounds);
    EXPECT_EQ(bodies, 1);
    const int alpha = red.size() > 1 ? red.back().fill->alpha : 0;
    EXPECT_EQ(alpha > 0, rate > 15.5) << rate;
    EXPECT_GE(alpha, before);
    EXPECT_EQ(blue.fill->alpha == 255, alpha == 0);
    if (red.size() > 1) {
      EXPECT_NEAR(red.back().bounds.x, seen->face, 1e-9);
      EXPECT_NEAR(red.back().bounds.right(), seen->red.x, 1e-9);
    }
    before = alpha;
  }
  EXPECT_LT(before, 140);
}

TEST(Loupe, SaysHowMuchSlowerTimeRuns) {
  const Frames frames(lecture(3) + Settings{{"time.slow-motion", "turn-0.1:turn+0.1:100"}});
  const auto texts = [](const std::vector<DrawItem>& items, ItemId thing) {
    std::string text;
    for (const auto& item : items_of<TextItem>(items, thing)) text += item.text;
    return text;
  };
  FrameState state = frames.state({frames.turn(), Rational(100)});
  DrawList frame = frames.of(state);
  EXPECT_EQ(texts(loupe_in(frame)->list.items, ItemId::label), "100× slower");
  EXPECT_EQ(texts(frame.items, ItemId::read_outs), "");
  state.gaps.y2 = 2;
  frame = frames.of(state);
  EXPECT_FALSE(loupe_in(frame));
  EXPECT_EQ(texts(frame.items, ItemId::read_outs), "100× slower");
}

TEST(Loupe, LeavesNoRoomForALabelThatItDoesNotHave) {
  const char* const kLong = "turn-0.1:turn+0.1:12345.6789";
  int seen = 0;
  for (const char* size :
       {"1280x720", "1080x1920", "800x800", "1024x768", "1600x600", "720x1600", "1280x560"}) {
    const Settings content =
        lecture(3, size) + Settings{{"show.overlays", "masses,velocities,time"}};
    const Frames plain(content);
    const Frames slow(content + Settings{{"time.slow-motion", kLong}});
    const auto without = loupe_in(plain.at(plain.turn()));
    const DrawList frame = slow.of(slow.state({slow.turn(), parse_rational("12345.6789")}));
    const auto with = loupe_in(frame);
    if (!without || !with) continue;
    ++seen;
    EXPECT_TRUE(items_of<TextItem>(with->list.items, ItemId::label).empty());
    EXPECT_EQ(items_of<TextItem>(frame.items, ItemId::read_outs).size(), 2U);
    EXPECT_EQ(with->red.height, without->red.height) << size;
    EXPECT_EQ(with->bounds.height, without->bounds.height) << size;
  }
  EXPECT_GT(seen, 3);
}

/// A place that something takes.
struct Taken {
  std::string what;
  double left;
  double top;
  double right;
  double bottom;
};

Taken taken(std::string what, const Rect& r) {
  return {std::move(what), r.x, r.y, r.right(), r.bottom()};
}

/// What the loupe must not cover: texts and blocks. Its own texts are checked against these too.
std::vector<Taken> places(const DrawList& frame, const Fonts& fonts) {
  std::vector<Taken> found;
  for (const DrawItem& item : frame.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) {
      const double width = fonts.of(text->face).width_em(text->text) * text->size_px;
      found.push_back({shows(text->id, ItemId::loupe) ? "zoom" : text->text, text->origin.x,
                       text->origin.y - Font::kCapHeight_em * text->size_px, text->origin.x + width,
                       text->origin.y + 0.22 * text->size_px});
    }
    const auto* box = std::get_if<RectangleItem>(&item);
    if (box != nullptr && shows(box->id, ItemId::red_block)) {
      found.push_back(taken("red", box->bounds));
    }
    if (box != nullptr && shows(box->id, ItemId::blue_block)) {
      found.push_back(taken("blue", box->bounds));
    }
    const auto* plate = std::get_if<PlateItem>(&item);
    if (plate != nullptr && plate->id >= ItemId::panels) {
      found.push_back(taken("panel", plate->bounds));
    }
    const auto* group = std::get_if<GroupItem>(&item);
    if (group != nullptr) found.push_back(taken("loupe", group->bounds));
  }
  return found;
}

void expect_apart(const DrawList& frame, const Fonts& fonts) {
  const std::vector<Taken> all = places(frame, fonts);
  for (const Taken& one : all) {
    if (one.what != "loupe" && one.what != "zoom") continue;
    EXPECT_GE(one.left, 0) << one.what;
    EXPECT_LE(one.right, frame.width_px) << one.what;
    for (const Taken& other : all) {
      const bool is_inside = one.what == "zoom" && other.what == "loupe";
      if (other.what == "zoom" || other.what == one.what || is_inside) continue;
      const bool overlap = one.left < other.right && other.left < one.right &&
                           one.top < other.bottom && other.top < one.bottom;
      EXPECT_FALSE(overlap) << one.what << " and " << other.what;
    }
  }
}

TEST(Loupe, HasRoomBesideTwoDiagrams) {
  for (const char* size : {"1920x1080", "1280x720", "1080x1920", "720x1600"}) {
    const Frames frames(lecture(5, size) +
                        Settings{{"show.title", "The turn of five digits"},
                                 {"show.overlays", "masses"},
                                 {"show.panels", "velocity,unfolded"},
                                 {"time.slow-motion", "turn-1e-6:turn+1e-6:1e7"}});
    EXPECT_TRUE(loupe_in(frames.at(frames.turn()))) << size;
  }
}

/// The lines to the inset begin at 60 % of red's width, and go away from the gap.
/// @param side  -1: the wall is on the right
void expect_lines_clear_of_the_gap(const DrawList& frame, int side) {
  constexpr std::size_t kFirstLine = 100;
  const Rect red = items_of<RectangleItem>(frame.items, ItemId::red_block).front().bounds;
  int lines = 0;
  for (const PathItem& line : items_of<PathItem>(frame.items, ItemId::wall)) {
    if (line.id < nth(ItemId::wall, kFirstLine)) continue;
    ++lines;
    const auto points = line.points.view();
    EXPECT_NEAR(points[0].x, red.x + (side > 0 ? 0.6 : 0.4) * red.width, 1);
    const bool is_above = std::max(points[0].y, points[1].y) < red.y;
    EXPECT_TRUE(is_above || (side > 0 ? points[1].x > red.right() : points[1].x < red.x));
  }
  EXPECT_EQ(lines, loupe_in(frame) ? 2 : 0);
}

TEST(Loupe, CoversNothingInAnyShape) {
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
            frames.emplace(side > 0 ? scene : turned_round(scene));
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

}  // namespace
}  // namespace piblocks
