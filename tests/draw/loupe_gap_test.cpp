// The loupe around any gap: beside a wall on the right, between any two blocks of a line.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "draw/lecture_frames.hpp"
#include "draw/mirrored.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

TEST(LoupeGap, OfAWallOnTheRightIsTurnedRound) {
  for (const int digits : {2, 5}) {
    const Scene scene = scene_with(lecture(digits));
    const Frames frames(scene);
    const Frames turned(mirrored(scene));
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
  if (gap * scale * kZoom > seen->bounds.width / 2) return;  // it may be too wide for the inset
  EXPECT_EQ(seen->zoom, "×20");
  EXPECT_NEAR(shown, gap * scale * kZoom, 1e-6);
  ++seen_times;
}

TEST(LoupeGap, EnlargesAnyGapThatClosesInItsWindow) {
  TracedRandom random(3411);
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

TEST(LoupeGap, HitsHaveTheColoursOfTheStage) {
  for (const bool is_outer_first : {false, true}) {
    Scene scene = mirrored(scene_with(lecture(3)));
    if (is_outer_first) std::swap(scene.system.bodies[0], scene.system.bodies[1]);
    const Frames frames(scene);
    for (const MetPair& pair : {MetPair{0, 1}, MetPair{is_outer_first ? 1U : 0U, 2}}) {
      FrameState shown = frames.state({frames.turn()});
      shown.hits = {
          Hit{.index = 1, .pair = pair, .contact = {}, .age_s = 0.05, .gaps = shown.gaps}};
      const DrawList frame = frames.of(shown);
      const auto color_in = [](const std::vector<DrawItem>& items) {
        return items_of<PathItem>(items, ItemId::hits).at(0).stroke.value().color;
      };
      EXPECT_EQ(color_in(loupe_in(frame).value().list.items), color_in(frame.items)) << pair[1];
    }
  }
}

TEST(LoupeGap, ShowsAFixedBlockAsOne) {
  Scene scene = scene_with(lecture(3));
  scene.system.bodies.push_back({std::nullopt, {-1}});
  scene.system.walls.clear();
  scene = as_bodies(scene);
  scene.styles.resize(3);
  scene.view.x = {-2, 8};
  const Frames frames(scene);
  const DrawList frame = frames.at(frames.turn());
  const auto seen = loupe_in(frame);
  ASSERT_TRUE(seen);
  const auto fixed = items_of<RectangleItem>(seen->list.items, ItemId::wall);
  ASSERT_EQ(fixed.size(), 1U);
  EXPECT_EQ(seen->face, 0) << "no hatched wall";
  EXPECT_EQ(fixed[0].bounds.height, seen->red.height);
  EXPECT_GE(seen->blue.x, fixed[0].bounds.right());
}

}  // namespace
}  // namespace piblocks
