// What python-billiards (github.com/markus-ebke/python-billiards) states in its tests and
// documents.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/log.hpp>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "physics/published_cases.hpp"

namespace piblocks {
namespace {

/// @param other  with unit disc 0 at rest in the origin
System beside_unit_disc(const Body& other) { return discs({disc({0, 0}), other}); }

TEST(PublishedCases, TimesOfImpactOfTwoBalls) {
  const Source program("python-billiards, tests/test_physics.py");
  const Rational small(std::numbers::sqrt2 - 1);
  const Rational root(std::numbers::sqrt2);
  expect_hits({
      {"toi_ball_ball: head-on", beside_unit_disc(disc({5, 0}, {-1, 0})), 3},
      {"toi_ball_ball: only relative coordinates matter",
       discs({disc({0, 42}, {42, 0}), disc({5, 42}, {41, 0})}), 3},
      {"toi_ball_ball: apart", beside_unit_disc(disc({2, 0}, {1, 0})), kNever},
      {"toi_ball_ball: sideways", beside_unit_disc(disc({2, 0}, {0, 1})), kNever},
      {"toi_ball_ball: impact along x", beside_unit_disc(disc({3, 0}, {-1, 0})), 1},
      {"toi_ball_ball: impact along y", beside_unit_disc(disc({0, 101}, {0, -33})), 3},
      {"toi_ball_ball: slides past", beside_unit_disc(disc({2, 10}, {0, -1})), kNever},
      {"toi_ball_ball: nearly slides past",
       beside_unit_disc(disc({root, root}, {Rational(1 - 1e-7), -1})),
       0,
       {},
       1e-8},
      {"toi_ball_ball: hit from the side", beside_unit_disc(disc({1, 2}, {0, -1}, small)), 1},
      {"toi_ball_ball: touches", beside_unit_disc(disc({2, 0}, {-1, 0})), 0},
      {"toi_ball_ball: touches at the side",
       beside_unit_disc(disc({Rational(1 + 1e-12), 1}, {0, -1}, small)),
       0,
       {},
       1e-6},
      // Points: the reach of 1 is halved between both.
      {"toi_ball_ball: point, head-on",
       discs({disc({0, 0}, {}, kHalf), disc({2, 0}, {-1, 0}, kHalf)}), 1},
      {"toi_ball_ball: point, slides",
       discs({disc({0, 0}, {}, kHalf), disc({1, 0}, {0, 1}, kHalf)}), kNever},
      {"toi_ball_ball: point, from the side",
       discs({disc({0, 0}, {}, kHalf), disc({kHalf, 1}, {0, -1}, kHalf)}), 1 - std::sqrt(3.0 / 4)},
      {"toi_ball_point: head-on", discs({disc({0, 0}, {1, 0}, kHalf), fixed({5, 0}, kHalf)}), 4},
      {"toi_ball_point: along y", discs({disc({0, 100}, {0, -33}, kHalf), fixed({0, 0}, kHalf)}),
       3},
      {"toi_ball_point: slides past", discs({disc({1, 10}, {0, -1}, kHalf), fixed({0, 0}, kHalf)}),
       kNever},
      {"toi_ball_point: from the side",
       discs({disc({1, 2}, {0, -1}, root / 2), fixed({0, 0}, root / 2)}), 1},
      {"toi_ball_segment: face of the segment",
       discs({disc({kHalf, 2}, {0, -1})}, {{"segment", {0, 0}, {0, 1}}}), 1},
      {"toi_ball_segment: ten times as large",
       discs({disc({5, 20}, {0, -10}, 10)}, {{"segment", {0, 0}, {0, 1}}}), 1},
      {"toi_ball_segment: along the line",
       discs({disc({1, 1}, {-1, -1}, kHalf)}, {{"segment", {0, 0}, {0, 1}}}), 0.5},
  });
}

TEST(PublishedCases, VelocitiesAfterElasticHits) {
  const Source program("python-billiards, tests/test_physics.py and tests/test_obstacles.py");
  const auto touching = [](const ExactVector& first, const ExactVector& second) {
    return discs({disc({0, 0}, first), disc({2, 0}, second)});
  };
  const std::vector<Wall> floor = {{"floor", {-1, 0}, {0, 1}}};
  const std::vector<Wall> ceiling = {{"ceiling", {-1, 0}, {0, -1}}};
  System light = touching({-1, 0}, {-20, 0});
  light.bodies[1].mass = 1 / power(10, 20);
  expect_hits({
      {"elastic_collision: struck at rest",
       touching({0, 0}, {-1, 0}),
       0,
       {velocity(-1, 0), velocity(0, 0)}},
      {"elastic_collision: head-on",
       touching({1, 0}, {-1, 0}),
       0,
       {velocity(-1, 0), velocity(1, 0)}},
      {"elastic_collision: strikes one at rest",
       touching({1, 0}, {0, 0}),
       0,
       {velocity(0, 0), velocity(1, 0)}},
      {"elastic_collision: sideways",
       touching({0, 0}, {-1, 1}),
       0,
       {velocity(-1, 0), velocity(0, 1)}},
      {"elastic_collision: sideways, half as fast",
       touching({0, 0}, {-kHalf, 1}),
       0,
       {velocity(-0.5, 0), velocity(0, 1)}},
      {"elastic_collision: sideways, fast",
       touching({0, 0}, {-42, Rational(1, 42)}),
       0,
       {velocity(-42, 0), velocity(0, 1.0 / 42)}},
      {"elastic_collision: without mass, here 1e-20", light, 0, {velocity(-1, 0), velocity(18, 0)}},
      {"elastic_collision: slides past", touching({0, 0}, {0, 1}), kNever},
      {"Disk: a ball meets an obstacle",
       discs({disc({-10, 0}, {1, 0}), fixed({0, 0})}),
       8,
       {{{-2, 0}, {-1, 0}}}},
      {"InfiniteWall: floor", discs({disc({0, 10}, {0, -1})}, floor), 9, {velocity(0, 1)}},
      {"InfiniteWall: floor, far along", discs({disc({-100, 10}, {0, -1})}, floor), 9},
      {"InfiniteWall: floor, aslant",
       discs({disc({0, 10}, {10, -1})}, floor),
       9,
       {velocity(10, 1)}},
      {"InfiniteWall: touches and approaches", discs({disc({0, 10}, {0, -1}, 10)}, floor), 0},
      {"InfiniteWall: touches and leaves", discs({disc({0, 10}, {0, 1}, 10)}, floor), kNever},
      {"InfiniteWall: ceiling", discs({disc({0, -10}, {10, 1})}, ceiling), 9, {velocity(10, -1)}},
  });
}

TEST(PublishedCases, TheEarliestOfThreePairsIsFirst) {
  const Source program("python-billiards, tests/test_simulation.py: test_toi_contents");
  const Body first = disc({0, 0});
  const Body second = disc({4, 0}, {-1, 0});
  const Body third = disc({0, 4}, {0, -2});
  expect_hits({{"first and second", discs({first, second}), 2},
               {"first and third", discs({first, third}), 1},
               {"second and third", discs({second, third}), 2, {}, 1e-6},
               {"all", discs({first, second, third}), 1}});
}

// Its second ball starts at 10.
TEST(PublishedCases, ObliqueHitOfUnequalMassesAndWhatFollows) {
  const Source program("python-billiards, tests/test_simulation.py: test_simple_collision");
  const System system = discs({disc({2, 0}, {4, 0}), disc({50, 18 + 10 * 9}, {0, -9}, 1, 2)});
  expect_hit({"collision",
              system,
              11.79693,
              {{{49.18772, 0}, {-4.0 / 3, -12}}, {{50, 1.827623}, {8.0 / 3, -3}}},
              5e-6});
  const State end = make_log(system)->state_at(14);
  EXPECT_EQ(end.count, 1);
  expect_motion("at the end, ball 1", {{46.2503, -26.43683}, {-4.0 / 3, -12}}, end.bodies[0], 5e-5);
  // Cut off, not rounded: 55.87485.
  expect_motion("at the end, ball 2", {{55.8748, -4.78158}, {8.0 / 3, -3}}, end.bodies[1], 6e-5);
}

// Balls 4 and 3 touch.
TEST(PublishedCases, CradleWithTwoBallsInContact) {
  const Source program("python-billiards, tests/test_simulation.py: test_newton_cradle");
  const auto log =
      make_log(discs({disc({-3, 0}, {1, 0}), disc({0, 0}), disc({5, 0}), disc({3, 0})}));
  expect_times("times", *log, {1, 2, 2}, kRoundings);
  EXPECT_EQ(log->last(), 3);
  const State first = log->state_at(1);
  expect_motion("at 1, ball 1", {{-2, 0}, {0, 0}}, first.bodies[0], kRoundings);
  expect_motion("at 1, ball 2", {{0, 0}, {1, 0}}, first.bodies[1], kRoundings);
  const State end = log->state_at(11);
  expect_motion("at the end, ball 2", {{1, 0}, {0, 0}}, end.bodies[1], kRoundings);
  expect_motion("at the end, ball 3", {{14, 0}, {1, 0}}, end.bodies[2], kRoundings);
  expect_motion("at the end, ball 4", {{3, 0}, {0, 0}}, end.bodies[3], kRoundings);
}

// Without mass is 1e-20 here. The ball of infinite mass moves, and is once more replaced by a
// moving wall.
TEST(PublishedCases, MovingBallOfInfiniteMass) {
  const Source program("python-billiards, tests/test_simulation.py: test_masses");
  const std::vector<Body> two = {disc({-3, 0}, {1, 0}, 1, 1 / power(10, 20)),
                                 disc({0, 0}, {}, 1, 42)};
  std::vector<Body> three = two;
  three.push_back(disc({4, 0}, {-1, 0}, 1, std::nullopt));
  for (const System& system : {discs(three), discs(two, {{"face", {3, 0}, {-1, 0}, {-1, 0}}})}) {
    const Source source(system.walls.empty() ? "a heavy ball" : "a moving wall");
    const auto log = make_log(system);
    expect_times("times", *log, {1, 2, 3}, kRoundings);
    EXPECT_EQ(log->last(), 3);
    expect_motion("at 1, ball 1", {{-2, 0}, {-1, 0}}, log->state_at(1).bodies[0], kRoundings);
    expect_motion("at 1, ball 2", {{0, 0}, {0, 0}}, log->state_at(1).bodies[1], kRoundings);
    expect_motion("at 2, ball 2", {{0, 0}, {-2, 0}}, log->state_at(2).bodies[1], kRoundings);
    expect_motion("at 3, ball 1", {{-4, 0}, {-3, 0}}, log->state_at(3).bodies[0], kRoundings);
    expect_motion("at 3, ball 2", {{-2, 0}, {-2, 0}}, log->state_at(3).bodies[1], kRoundings);
  }
  expect_motion("at 2, ball 3", {{2, 0}, {-1, 0}}, make_log(discs(three))->state_at(2).bodies[2],
                kRoundings);
}

// Without the second ball of infinite mass, since nothing can move two such balls aside.
TEST(PublishedCases, PointWithoutMassMeetsInfiniteMass) {
  const Source program("python-billiards, tests/test_simulation.py: test_exceptional_balls");
  const System system = discs({disc({-3, 0}, {1, 0}, kHalf), fixed({0, 0}, kHalf)});
  expect_hit({"collision", system, 2, {{{-1, 0}, {-1, 0}}, {{0, 0}, {0, 0}}}});
  expect_motion("at 5, ball 1", {{-4, 0}, {-1, 0}}, make_log(system)->state_at(5).bodies[0],
                kRoundings);
}

std::vector<Wall> ends(const Rational& left, const Rational& right) {
  return {{"left", {left, 0}, {1, 0}}, {"right", {right, 0}, {-1, 0}}};
}

TEST(PublishedCases, CradlesBetweenWalls) {
  const Source program(
      "python-billiards, tests/test_simulation.py: test_callbacks, and docs/usage.rst");
  const auto two = make_log(discs({disc({-3, 0}, {1, 0}), disc({2, 0})}, ends(-4, 7)));
  expect_times("two balls", *two, {3, 7, 11, 14}, kRoundings);
  EXPECT_EQ(two->count_at(15), 4);
  std::vector<Body> row = {disc({-3, 0}, {2, 0})};
  expect_hit({"the first ball alone", discs(row, ends(-4, 10)), 6});
  for (int k = 0; k < 4; ++k) row.push_back(disc({Rational(21 * k, 10), 0}));
  const auto five = make_log(discs(row, ends(-4, 10)));
  expect_times("five balls", *five, {0.5, 0.55, 0.6, 0.65, 2, 3.35, 3.4, 3.45, 3.5, 4}, 5e-3);
  // At 4 all is as it was at first.
  EXPECT_EQ(five->count_at(Rational(399, 100)), 9);
  expect_motion("at 4, ball 1", {{-3, 0}, {2, 0}}, five->state_at(4).bodies[0], 1e-13);
}

// The film there ends at 12, when all is as it was at first. From
// then on to 30 the third ball is 1e-10 off the line of the others.
TEST(PublishedCases, CradleThatIsSlightlyOffItsLine) {
  const Source program("python-billiards, docs/usage.rst");
  std::vector<Body> row = {disc({-3, 0}, {2, 0})};
  for (int k = 0; k < 4; ++k) row.push_back(disc({Rational(21 * k, 10), 0}));
  row[2].position[1] = Rational(1e-10);
  const auto log = make_log(discs(row, ends(-4, 10)));
  int balls = 0;
  int walls = 0;
  for (Integer k = 1; k <= log->count_at(18); ++k) {
    ++(log->collision(k).second < row.size() ? balls : walls);
  }
  expect_said("hits of balls", 36, balls, 0);
  expect_said("hits of walls", 8, walls, 0);
}

/// The light ball or block first.
void expect_pool(const System& system) {
  const Source source(system.dimensions == 1 ? "blocks" : "discs");
  const auto log = make_log(system);
  expect_times("first", *log, {1.8}, kRoundings);
  for (const auto& [time, said] :
       {std::pair{1, 0}, {2, 1}, {3, 1}, {4, 4}, {5, 314152}, {16, 314159}}) {
    expect_said(fmt::format("count at {}", time), said, log->count_at(time).get_d(), 0);
  }
  EXPECT_EQ(log->last(), 314159);
  const State end = log->state_at(16);
  expect_motion("at the end, ball 1", velocity(0.73463055, 0), end.bodies[0], 5e-9);
  expect_motion("at the end, ball 2", velocity(1, 0), end.bodies[1], 5e-9);
  expect_said("energy", 5e9, energy_of(system, end.bodies), 0.5);
}

// In closed form, and stepped as discs.
TEST(PublishedCases, PoolCountsSixDigitsOfPi) {
  const Source program("python-billiards, README.md: \"Computing pi with pool\"");
  const Rational heavy = power(100, 5);
  const System line = {.bodies = {{1, {3}, {}, Rational(2, 5)}, {heavy, {6}, {-1}, 2}},
                       .walls = {{"wall", {0}, {1}}}};
  const System plane = discs({disc({3, 0}, {}, Rational(1, 5)), disc({6, 0}, {-1, 0}, 1, heavy)},
                             {{"wall", {0, 0}, {1, 0}}});
  expect_pool(line);
  expect_pool(plane);
}

}  // namespace
}  // namespace piblocks
