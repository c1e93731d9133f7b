// Marks of hits are where the log has them, for 0.15 s; where hits are many, a steady glow.
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <string>

#include "draw/lecture_frames.hpp"
#include "draw/overlays/loupe.hpp"
#include "render/film.hpp"
#include "render/flash_meter.hpp"
#include "support/contains.hpp"

namespace piblocks {
namespace {
using testing_support::contains;

Settings without_loupe(int digits) {
  return {{"digits", std::to_string(digits)},
          {"view.theme", "lecture"},
          {"view.size", "1280x720"},
          {"time.to", "last+0.5"},
          {"show.loupe", "off"}};
}

// Blue and what it meets.
constexpr MetPair kRed = {0, 1};
constexpr MetPair kWall = {0, 2};

struct Arc {
  Point centre;
  double radius = 0;
  Color color;
};

/// The circle through three of its points.
Arc arc_of(const PathItem& item) {
  const auto points = item.points.view();
  const Point a = points.front();
  const Point b = points[points.size() / 2];
  const Point c = points.back();
  const double d = 2 * (a.x * (b.y - c.y) + b.x * (c.y - a.y) + c.x * (a.y - b.y));
  const auto square = [](const Point& p) { return p.x * p.x + p.y * p.y; };
  const double x =
      (square(a) * (b.y - c.y) + square(b) * (c.y - a.y) + square(c) * (a.y - b.y)) / d;
  const double y =
      (square(a) * (c.x - b.x) + square(b) * (a.x - c.x) + square(c) * (b.x - a.x)) / d;
  return {{x, y}, std::hypot(a.x - x, a.y - y), item.stroke ? item.stroke->color : Color{}};
}

/// Of the newest hit: blue's edge, and red's unless blue has met the wall. They are inside their
/// blocks, between the round corners, which have a radius of 0.004 of 720 rows.
void expect_edges(const DrawList& frame, bool is_wall, bool is_flash) {
  std::vector<RectangleItem> edges = items_of<RectangleItem>(frame.items, ItemId::hits);
  if (!is_flash) return;
  const Rect blue = items_of<RectangleItem>(frame.items, ItemId::blue_block).front().bounds;
  const Rect red = items_of<RectangleItem>(frame.items, ItemId::red_block).front().bounds;
  const auto count_at = [&](double x, const Rect& block) {
    return std::ranges::count_if(edges, [&](const RectangleItem& edge) {
      return std::fabs(edge.bounds.x - x) < 1e-6 && std::fabs(edge.bounds.width - 3.6) < 1e-9 &&
             std::fabs(edge.bounds.y - (block.y + 2.88)) < 1e-6 &&
             std::fabs(edge.bounds.height - (block.height - 5.76)) < 1e-6;
    });
  };
  EXPECT_EQ(count_at(is_wall ? blue.x : blue.right() - 3.6, blue), 1);
  if (!is_wall) {
    EXPECT_EQ(count_at(red.x, red), 1);
  }
}

/// Every collision of the last 0.15 s has its arc, and nothing else has.
TEST(HitMarks, AreWhereTheLogHasThem) {
  for (const int digits : {1, 2}) {
    SCOPED_TRACE(digits);
    const Frames frames(without_loupe(digits));
    const PairLog& log = *frames.log().pair();
    const Schedule schedule = make_schedule(frames.scene(), log);
    int arcs_seen = 0;
    int flashes_seen = 0;
    for (std::int64_t number = 0; number < schedule.frame_count().get_si(); ++number) {
      const FrameState state = frames.film_state(schedule, number);
      if (state.hits_per_s > kMaxHitsPerSecond) continue;
      const DrawList frame = frames.of(state);
      const auto items = items_of<PathItem>(frame.items, ItemId::hits);
      const double now = double(number) / 60;
      std::size_t next = 0;
      for (Integer k = 1; k <= log.last(); ++k) {
        const PairCollision collision = log.blocks_collision(k);
        const double age = now - collision.time.hi;
        if (age < 0 || age >= 0.15 - 1e-9) continue;
        ASSERT_LT(next, items.size());
        const Arc arc = arc_of(items[next++]);
        const auto blue = items_of<RectangleItem>(frame.items, ItemId::blue_block).front().bounds;
        const double scale = blue.width;
        const double present = log.blocks_at(state.time).blue.position;
        const bool is_wall = collision.kind == CollisionKind::wall;
        const double contact = is_wall ? 0 : collision.blue.position + 0.5;
        EXPECT_NEAR(arc.centre.x, blue.x + (contact - present + 0.5) * scale, 1e-6);
        EXPECT_NEAR(arc.centre.y, blue.y, 1e-6);
        const double left = 1 - age / 0.15;
        EXPECT_NEAR(arc.radius, 0.06 * 720 * (1 - 0.7 * left * left), 1e-6);
        EXPECT_NEAR(items[next - 1].stroke->width_px, 0.005 * 720, 1e-9);
        // Two frames, of 60 a second, in the color of text.
        const bool is_flash = age < 2.0 / 60 - 1e-9;
        flashes_seen += is_flash ? 1 : 0;
        EXPECT_NEAR(arc.color.alpha, is_flash ? 255 : 255 * left, 0.6);
        EXPECT_EQ(arc.color.blue, is_flash ? 245 : is_wall ? 255 : 94);
        expect_edges(frame, is_wall, is_flash);
        ++arcs_seen;
      }
      EXPECT_EQ(next, items.size()) << number;
    }
    EXPECT_GT(arcs_seen, 20);
    EXPECT_GT(flashes_seen, 4);
  }
}

/// The glows' alphas, added up.
int glow_of(const DrawList& frame) {
  int sum = 0;
  for (const PlateItem& plate : items_of<PlateItem>(frame.items, ItemId::hits)) {
    for (const GlowItem& glow : items_of<GlowItem>(plate.plate->items)) sum += glow.color.alpha;
  }
  return sum;
}

TEST(HitMarks, GlowByTheLogarithmOfTheRate) {
  const Frames frames(without_loupe(3));
  FrameState state = frames.state({frames.turn()});
  state.met_pairs = {kRed, kWall};
  int before = 0;
  for (double rate = 1; rate < 1e40; rate *= 1.5) {
    state.hits_per_s = rate;
    const int glow = glow_of(frames.of(state));
    EXPECT_EQ(glow > 0, rate > kMaxHitsPerSecond) << rate;
    EXPECT_GE(glow, before) << rate;
    // A little more light for half as many hits again.
    if (before > 0) {
      EXPECT_LE(glow, 1.16 * before) << rate;
    }
    before = glow;
  }
}

/// Of any number of colours.
TEST(HitMarks, GlowWhereverTheyAreTooMany) {
  Scene scene = scene_with(without_loupe(1));
  System system{1, {}, {{"left", {0, 0}, {1, 0}}}};
  for (int i = 0; i < 40; ++i) {
    system.bodies.push_back({.position = {1 + i, 0}, .velocity = {-i, 0}, .size = Rational(1, 2)});
  }
  scene.system = system;
  scene.styles.resize(40);
  for (std::uint8_t i = 0; i < 40; ++i)
    scene.styles[i].color = std::array<std::uint8_t, 3>{200, static_cast<std::uint8_t>(6 * i), 50};
  scene.view.x = {0, 42};
  scene.time.to = Rational(1);
  const auto log = make_log(system);
  const Composition composition(scene, *log);
  FrameState state{.state = log->state_at(0)};
  state.hits_per_s = 1e6;
  const auto first_glow = [&](std::uint32_t body) {
    state.met_pairs = {{body, body + 1}};
    return glow_of(composition.frame(state));
  };
  for (std::uint32_t body = 0; body < 39; ++body)
    EXPECT_EQ(first_glow(body), first_glow(0)) << body;
}

/// The count is largest in the frame of a hit, by 6 %, and has its size again 0.12 s later.
TEST(HitMarks, MakeTheCountLargerForAMoment) {
  const Frames frames(without_loupe(2));
  FrameState state = frames.state({frames.turn()});
  const auto count_at = [&](double age_s) {
    state.hits = {{1, kWall, {0, 0}, age_s, {}}};
    return item_of<TextItem>(frames.of(state), ItemId::count);
  };
  const TextItem still = item_of<TextItem>(frames.at(frames.turn()), ItemId::count);
  EXPECT_EQ(still.size_px, 0.15 * 720);
  EXPECT_NEAR(count_at(0).size_px, 1.06 * still.size_px, 0.5);
  double before = count_at(0).size_px;
  for (double age_s = 0.005; age_s < 0.12; age_s += 0.005) {
    const double now = count_at(age_s).size_px;
    EXPECT_LE(now, before);
    EXPECT_LE(before - now, 2);
    before = now;
  }
  EXPECT_EQ(count_at(0.12).size_px, still.size_px);
  EXPECT_EQ(count_at(0.14).origin, still.origin);
  // Its middle stays.
  const double half_em = Fonts().of(Face::digits).width_em(still.text) / 2;
  EXPECT_NEAR(count_at(0).origin.x + half_em * count_at(0).size_px,
              still.origin.x + half_em * still.size_px, 1e-9);
  state.hits_per_s = 9;
  state.hits.clear();
  EXPECT_EQ(item_of<TextItem>(frames.of(state), ItemId::count), still);
}

TEST(HitMarks, GlowFadesFromItsCentreToNothing) {
  const GlowItem glow{ItemId::hits, {10, 10, 40, 20}, {30, 30}, 20, {255, 0, 0, 200}};
  const DrawList list{64, 40, Color{0, 0, 0}, {glow}};
  const std::vector<std::uint32_t> pixels = painted(list);
  const auto red_at = [&](std::size_t x, std::size_t y) {
    return int(pixels[64 * y + x] >> 16 & 255);
  };
  // (1 - d^2)^2 of the color, d in radii.
  EXPECT_NEAR(red_at(29, 29), 200, 2);
  EXPECT_NEAR(red_at(39, 29), 200 * std::pow(1 - (9.5 * 9.5 + 0.5 * 0.5) / 400, 2), 1);
  EXPECT_EQ(red_at(39, 29), red_at(20, 29));
  EXPECT_LE(red_at(49, 29), 1);
  EXPECT_EQ(red_at(29, 30), 0);  // cut off
  for (std::size_t x = 31; x < 50; ++x) EXPECT_LE(red_at(x, 29), red_at(x - 1, 29));
  const auto svg = draw_svg(list);
  EXPECT_TRUE(contains(std::string(svg.begin(), svg.end()), "<radialGradient"));
  const auto pdf = draw_pdf(list);
  EXPECT_FALSE(contains(std::string(pdf.begin(), pdf.end()), "/Image"));
}

TEST(HitMarks, OfTheWallAndOfBlocksAreInTheCornersAboveTheLowerBody) {
  for (const char* mass : {"1/4", "1", "100"}) {
    SCOPED_TRACE(mass);
    const Frames frames(Settings{{"view.theme", "lecture"}, {"mass-ratio", mass}});
    FrameState state = frames.state({Rational(3)});
    state.hits = {{1, kWall, {0, 0}, 0.1, {}}, {2, kRed, {1, 0}, 0.05, {}}};
    const DrawList frame = frames.of(state);
    const auto items = items_of<PathItem>(frame.items, ItemId::hits);
    ASSERT_EQ(items.size(), 2U);
    const auto blue = items_of<RectangleItem>(frame.items, ItemId::blue_block).front().bounds;
    const auto red = items_of<RectangleItem>(frame.items, ItemId::red_block).front().bounds;
    const Rect arc = items[1].points.bounds();
    EXPECT_LT(items[0].points.bounds().bottom(), blue.y);
    EXPECT_LT(arc.bottom(), std::max(blue.y, red.y));
    const double contact = arc_of(items[1]).centre.x;
    EXPECT_EQ(arc.x < contact, blue.height <= red.height);
    EXPECT_EQ(arc.right() > contact, red.height <= blue.height);
  }
}

TEST(HitMarks, AreLeftOutWhereTheyAreNotWanted) {
  for (const Settings& settings :
       {Settings{{"digits", "2"}}, Settings{{"digits", "2"}, {"show.hits", "true"}},
        Settings{{"view.theme", "lecture"}, {"show.hits", "false"}, {"show.loupe", "auto"}}}) {
    const Frames frames(settings);
    FrameState state = frames.state({frames.turn()});
    state.hits = {{1, kWall, {0, 0}, 0.1, {}}};
    const DrawList frame = frames.of(state);
    EXPECT_TRUE(items_of<PathItem>(frame.items, ItemId::hits).empty());
    if (const auto seen = loupe_in(frame)) {
      EXPECT_TRUE(items_of<PathItem>(seen->list.items, ItemId::hits).empty());
    }
    // Finding hits takes time: it is done only where hits, or what blocks sweep, are shown.
    const Schedule schedule = make_schedule(frames.scene(), frames.log());
    EXPECT_EQ(frames.film_state(schedule, 220).hits_per_s > 0, loupe_in(frame).has_value());
  }
}

TEST(HitMarks, AreInTheLoupeToo) {
  Settings settings = without_loupe(5);
  settings.back() = {"show.loupe", "auto"};
  const Frames frames(settings);
  FrameState state = frames.state({frames.turn()});
  const Gaps gaps = state.gaps;
  state.hits = {{1, kWall, {0, 0}, 0.1, {0, gaps.y2}},
                {2, kRed, {1 + gaps.y2, 0}, 0.05, {gaps.y2 / 2, gaps.y2 / 2}}};
  const auto seen = loupe_in(frames.of(state));
  ASSERT_TRUE(seen);
  const auto items = items_of<PathItem>(seen->list.items, ItemId::hits);
  ASSERT_EQ(items.size(), 2U);
  const double red_gap = seen->red.x - seen->blue.width - seen->face;
  EXPECT_NEAR(arc_of(items[0]).centre.x, seen->face, 1e-6);
  EXPECT_NEAR(arc_of(items[1]).centre.x, seen->face + seen->blue.width + red_gap / 2, 1e-6);
  EXPECT_NEAR(arc_of(items[1]).centre.y, seen->blue.y, 1e-6);
}

TEST(HitMarks, AndTheLoupeDoNotFlash) {
  for (int digits = 1; digits <= 8; ++digits) {
    for (const char* theme : {"lecture", "lecture-light"}) {
      SCOPED_TRACE(digits);
      Settings settings = {{"digits", std::to_string(digits)},
                           {"view.theme", theme},
                           {"view.size", "640x360"},
                           {"time.from", "2"},
                           {"time.to", "5"}};
      if (digits % 2 == 0) settings.emplace_back("time.slow-motion", "turn-1/50:turn+1/50:100");
      const Film film{Script(scene_with(settings))};
      EXPECT_NO_THROW(check_flashes(film, 3, std::stop_token()));
    }
  }
}

/// Ten hits a second at the turn: blue crosses the loupe, and red hardly moves.
TEST(Loupe, ShowsTheTurnHappening) {
  for (const auto& [digits, window] :
       {std::pair(5, "turn-1/10^6:turn+1/10^6:10^7"), {20, "turn-1/10^36:turn+1/10^36:10^37"}}) {
    SCOPED_TRACE(digits);
    Settings settings = without_loupe(digits);
    settings.back() = {"show.loupe", "auto"};
    settings.emplace_back("time.from", "turn");
    settings.emplace_back("time.to", digits == 5 ? "turn+1/10^6" : "turn+1/10^36");
    settings.emplace_back("time.slow-motion", window);
    settings.emplace_back("view.fps", "30");
    // No double has the time of the turn.
    settings.emplace_back("red.position", "16/3");
    const Frames frames(settings);
    const Schedule schedule = make_schedule(frames.scene(), frames.log());
    double low = 1;
    double high = 0;
    double red_low = 1e9;
    double red_high = 0;
    int arcs = 0;
    for (std::int64_t number = 0; number < 60; ++number) {
      const FrameState state = frames.film_state(schedule, number);
      const auto seen = loupe_in(frames.of(state));
      ASSERT_TRUE(seen);
      const double room = seen->red.x - seen->face - seen->blue.width;
      low = std::min(low, (seen->blue.x - seen->face) / room);
      high = std::max(high, (seen->blue.x - seen->face) / room);
      red_low = std::min(red_low, seen->red.x);
      red_high = std::max(red_high, seen->red.x);
      for (const auto& item : items_of<PathItem>(seen->list.items, ItemId::hits)) {
        arcs += item.stroke ? 1 : 0;
      }
    }
    EXPECT_LT(low, 0.1);
    EXPECT_GT(high, 0.9);
    EXPECT_LT(red_high - red_low, 1);
    EXPECT_GT(arcs, 20);
  }
}

}  // namespace
}  // namespace piblocks
