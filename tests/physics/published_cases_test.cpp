// What tests and examples of other public programs state about collisions.
// In: their bodies and walls, typed anew. Out: piblocks finds their numbers, to the digits that
// they give. Where they have a point, there is a disc, and the walls are further away by its
// radius.
#include <gtest/gtest.h>
#include <piblocks/log.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace piblocks {
namespace {

constexpr double kNotSaid = std::numeric_limits<double>::quiet_NaN();
constexpr double kNever = std::numeric_limits<double>::infinity();
/// Of numbers that the source gives as fractions and roots.
constexpr double kRoundings = 1e-14;

const Rational kHalf(1, 2);

/// The first collision, and what bodies do just after it and all others at that instant.
struct Hit {
  const char* source;
  System system;
  double time;
  std::vector<Motion> after = {};  ///< of the first bodies
  double tolerance = kRoundings;
  double energy_lost = kNotSaid;
};

System discs(std::vector<Body> bodies, std::vector<Wall> walls = {}, const Rational& e = 1) {
  return {.dimensions = 2,
          .bodies = std::move(bodies),
          .walls = std::move(walls),
          .restitution = e,
          .wall_restitution = e};
}

Body disc(const ExactVector& position, const ExactVector& velocity = {}, const Rational& radius = 1,
          const std::optional<Rational>& mass = 1) {
  return {mass, position, velocity, radius};
}

Body fixed(const ExactVector& position, const Rational& radius = 1) {
  return disc(position, {}, radius, std::nullopt);
}

std::vector<Wall> box(const Rational& low, const Rational& high) {
  return {{"left", {low, 0}, {1, 0}},
          {"right", {high, 0}, {-1, 0}},
          {"bottom", {0, low}, {0, 1}},
          {"top", {0, high}, {0, -1}}};
}

Motion velocity(double x, double y) { return {{kNotSaid, kNotSaid}, {x, y}}; }

void expect_said(const char* what, double said, double ours, double tolerance) {
  if (std::isnan(said)) return;
  EXPECT_NEAR(ours, said, tolerance) << what;
}

void expect_motion(const Motion& said, const Motion& ours, double tolerance) {
  expect_said("x", said.position[0], ours.position[0], tolerance);
  expect_said("y", said.position[1], ours.position[1], tolerance);
  expect_said("velocity along x", said.velocity[0], ours.velocity[0], tolerance);
  expect_said("velocity along y", said.velocity[1], ours.velocity[1], tolerance);
}

double energy_of(const System& system, const std::vector<Motion>& motions) {
  double sum = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto& v = motions[i].velocity;
    const auto& mass = system.bodies[i].mass;
    if (mass) sum += to_double(*mass) / 2 * (v[0] * v[0] + v[1] * v[1]);
  }
  return sum;
}

/// The bodies just after the first collision and all others at that instant.
std::vector<Motion> after_first(const Log& log) {
  std::vector<Motion> motions = log.state_at(0).bodies;
  const double first = log.collision(1).time.hi;
  for (Integer k = 1; log.has(k) && log.collision(k).time.hi == first; ++k) {
    const Collision found = log.collision(k);
    motions[found.first] = found.first_after;
    if (found.second < motions.size()) motions[found.second] = found.second_after;
  }
  return motions;
}

void expect_hit(const Hit& hit) {
  SCOPED_TRACE(hit.source);
  const auto log = make_log(hit.system);
  ASSERT_EQ(log->has(1), hit.time != kNever);
  if (hit.time == kNever) return;
  expect_said("time", hit.time, log->collision(1).time.hi, hit.tolerance);
  const std::vector<Motion> after = after_first(*log);
  for (std::size_t i = 0; i < hit.after.size(); ++i) {
    SCOPED_TRACE(i);
    expect_motion(hit.after[i], after[i], hit.tolerance);
  }
  std::vector<Motion> start;
  for (const Body& body : hit.system.bodies) {
    start.push_back({{}, {to_double(body.velocity[0]), to_double(body.velocity[1])}});
  }
  expect_said("energy lost", hit.energy_lost,
              energy_of(hit.system, start) - energy_of(hit.system, after), hit.tolerance);
}

void expect_hits(const std::vector<Hit>& hits) {
  for (const Hit& hit : hits) expect_hit(hit);
}

/// Times of the first collisions.
void expect_times(const char* source, const Log& log, const std::vector<double>& times,
                  double tolerance) {
  SCOPED_TRACE(source);
  for (std::size_t k = 0; k < times.size(); ++k) {
    expect_said("time", times[k], log.collision(Integer(k + 1)).time.hi, tolerance);
  }
}

const double kRootTwo = std::sqrt(2);

/// @param other  with unit disc 0 at rest in the origin
System beside_unit_disc(const Body& other) { return discs({disc({0, 0}), other}); }

// python-billiards, tests/test_physics.py.
TEST(PublishedCases, TimesOfImpactOfTwoBalls) {
  const Rational small(kRootTwo - 1);
  const Rational root(kRootTwo);
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

// python-billiards, tests/test_physics.py and tests/test_obstacles.py.
TEST(PublishedCases, VelocitiesAfterElasticHits) {
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

// python-billiards, tests/test_simulation.py: test_toi_contents.
TEST(PublishedCases, TheEarliestOfThreePairsIsFirst) {
  const Body first = disc({0, 0});
  const Body second = disc({4, 0}, {-1, 0});
  const Body third = disc({0, 4}, {0, -2});
  expect_hits({{"first and second", discs({first, second}), 2},
               {"first and third", discs({first, third}), 1},
               {"second and third", discs({second, third}), 2, {}, 1e-6},
               {"all", discs({first, second, third}), 1}});
}

// python-billiards, tests/test_simulation.py: test_simple_collision. Its second ball starts at 10.
TEST(PublishedCases, ObliqueHitOfUnequalMassesAndWhatFollows) {
  const System system = discs({disc({2, 0}, {4, 0}), disc({50, 18 + 10 * 9}, {0, -9}, 1, 2)});
  expect_hit({"collision",
              system,
              11.79693,
              {{{49.18772, 0}, {-4.0 / 3, -12}}, {{50, 1.827623}, {8.0 / 3, -3}}},
              5e-6});
  const State end = make_log(system)->state_at(14);
  EXPECT_EQ(end.count, 1);
  expect_motion({{46.2503, -26.43683}, {-4.0 / 3, -12}}, end.bodies[0], 5e-5);
  // Cut off, not rounded: 55.87485.
  expect_motion({{55.8748, -4.78158}, {8.0 / 3, -3}}, end.bodies[1], 6e-5);
}

// python-billiards, tests/test_simulation.py: test_newton_cradle. Balls 4 and 3 touch.
TEST(PublishedCases, CradleWithTwoBallsInContact) {
  const auto log =
      make_log(discs({disc({-3, 0}, {1, 0}), disc({0, 0}), disc({5, 0}), disc({3, 0})}));
  expect_times("times", *log, {1, 2, 2}, kRoundings);
  EXPECT_EQ(log->last(), 3);
  const State first = log->state_at(1);
  expect_motion({{-2, 0}, {0, 0}}, first.bodies[0], kRoundings);
  expect_motion({{0, 0}, {1, 0}}, first.bodies[1], kRoundings);
  const State end = log->state_at(11);
  expect_motion({{1, 0}, {0, 0}}, end.bodies[1], kRoundings);
  expect_motion({{14, 0}, {1, 0}}, end.bodies[2], kRoundings);
  expect_motion({{3, 0}, {0, 0}}, end.bodies[3], kRoundings);
}

// python-billiards, tests/test_simulation.py: test_masses; without mass is 1e-20 here. The ball of
// infinite mass moves, and is once more replaced by a moving wall.
TEST(PublishedCases, MovingBallOfInfiniteMass) {
  const std::vector<Body> two = {disc({-3, 0}, {1, 0}, 1, 1 / power(10, 20)),
                                 disc({0, 0}, {}, 1, 42)};
  std::vector<Body> three = two;
  three.push_back(disc({4, 0}, {-1, 0}, 1, std::nullopt));
  for (const System& system : {discs(three), discs(two, {{"face", {3, 0}, {-1, 0}, {-1, 0}}})}) {
    const auto log = make_log(system);
    expect_times("times", *log, {1, 2, 3}, kRoundings);
    EXPECT_EQ(log->last(), 3);
    expect_motion({{-2, 0}, {-1, 0}}, log->state_at(1).bodies[0], kRoundings);
    expect_motion({{0, 0}, {0, 0}}, log->state_at(1).bodies[1], kRoundings);
    expect_motion({{0, 0}, {-2, 0}}, log->state_at(2).bodies[1], kRoundings);
    expect_motion({{-4, 0}, {-3, 0}}, log->state_at(3).bodies[0], kRoundings);
    expect_motion({{-2, 0}, {-2, 0}}, log->state_at(3).bodies[1], kRoundings);
  }
  expect_motion({{2, 0}, {-1, 0}}, make_log(discs(three))->state_at(2).bodies[2], kRoundings);
}

// python-billiards, tests/test_simulation.py: test_exceptional_balls, without its second ball of
// infinite mass, since nothing can move two such balls aside.
TEST(PublishedCases, PointWithoutMassMeetsInfiniteMass) {
  const System system = discs({disc({-3, 0}, {1, 0}, kHalf), fixed({0, 0}, kHalf)});
  expect_hit({"collision", system, 2, {{{-1, 0}, {-1, 0}}, {{0, 0}, {0, 0}}}});
  expect_motion({{-4, 0}, {-1, 0}}, make_log(system)->state_at(5).bodies[0], kRoundings);
}

std::vector<Wall> ends(const Rational& left, const Rational& right) {
  return {{"left", {left, 0}, {1, 0}}, {"right", {right, 0}, {-1, 0}}};
}

// python-billiards, tests/test_simulation.py: test_callbacks, and docs/usage.rst.
TEST(PublishedCases, CradlesBetweenWalls) {
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
  expect_motion({{-3, 0}, {2, 0}}, five->state_at(4).bodies[0], 1e-13);
}

// python-billiards, docs/usage.rst. The film there ends at 12, when all is as it was at first. From
// then on to 30 the third ball is 1e-10 off the line of the others.
TEST(PublishedCases, CradleThatIsSlightlyOffItsLine) {
  std::vector<Body> row = {disc({-3, 0}, {2, 0})};
  for (int k = 0; k < 4; ++k) row.push_back(disc({Rational(21 * k, 10), 0}));
  row[2].position[1] = Rational(1e-10);
  const auto log = make_log(discs(row, ends(-4, 10)));
  int balls = 0;
  int walls = 0;
  for (Integer k = 1; k <= log->count_at(18); ++k) {
    ++(log->collision(k).second < row.size() ? balls : walls);
  }
  EXPECT_EQ(balls, 36);
  EXPECT_EQ(walls, 8);
}

/// The light ball or block first.
void expect_pool(const System& system) {
  SCOPED_TRACE(system.dimensions);
  const auto log = make_log(system);
  expect_times("first", *log, {1.8}, kRoundings);
  std::vector<Integer> counts;
  for (int time = 1; time <= 5; ++time) counts.push_back(log->count_at(time));
  EXPECT_EQ(counts, (std::vector<Integer>{0, 1, 1, 4, 314152}));
  EXPECT_EQ(log->last(), 314159);
  const State end = log->state_at(16);
  expect_motion(velocity(0.73463055, 0), end.bodies[0], 5e-9);
  expect_motion(velocity(1, 0), end.bodies[1], 5e-9);
  expect_said("energy", 5e9, energy_of(system, end.bodies), 0.5);
}

// python-billiards, README.md: "Computing pi with pool"; in closed form, and stepped as discs.
TEST(PublishedCases, PoolCountsSixDigitsOfPi) {
  const Rational heavy = power(100, 5);
  const System line = {.bodies = {{1, {3}, {}, Rational(2, 5)}, {heavy, {6}, {-1}, 2}},
                       .walls = {{"wall", {0}, {1}}}};
  const System plane = discs({disc({3, 0}, {}, Rational(1, 5)), disc({6, 0}, {-1, 0}, 1, heavy)},
                             {{"wall", {0, 0}, {1, 0}}});
  expect_pool(line);
  expect_pool(plane);
}

// HardSphereDynamics.jl, test/runtests.jl.
TEST(PublishedCases, HardSpheres) {
  expect_hits({
      {"FixedPlane", discs({disc({0, 0}, {1, 0}, 2)}, {{"plane", {10, 0}, {-1, 0}}}), 8},
      {"two MovableBalls, glancing",
       discs({disc({0, 0}, {1, 0}), disc({10, kHalf}, {-1, 0})}),
       4.031754163448146,
       {velocity(-0.8750000000000002, -0.48412291827592724)}},
  });
}

// tms-ninja/billiards, testing/test_billiards.py: smooth discs.
TEST(PublishedCases, SmoothDiscsInABox) {
  const std::vector<Wall> ten = box(0, 10);
  const std::vector<Wall> twenty = box(-20, 20);
  std::vector<Wall> diagonal = box(-10, 10);
  diagonal.push_back({"diagonal", {0, 0}, {1, -1}});
  const double half_root = kRootTwo / 2;
  expect_hits({
      {"wall_col_vertical", discs({disc({3, 3}, {-1, 1})}, ten), 2, {{{1, 5}, {1, 1}}}},
      {"wall_col_horizontal", discs({disc({3, 7}, {1, 1})}, ten), 2, {{{5, 9}, {1, -1}}}},
      {"wall_col_diagonal",
       discs({disc({3, 0}, {0, 1})}, diagonal),
       3 - kRootTwo,
       {{{3, 3 - kRootTwo}, {1, 0}}}},
      {"col_vertical",
       discs({disc({3, 0}, {0, 1}), disc({3, 10}, {0, -1})}, twenty),
       4,
       {{{3, 4}, {0, -1}}, {{3, 6}, {0, 1}}}},
      {"col_horizontally",
       discs({disc({0, 0}, {1, 0}), disc({10, 0}, {-1, 0})}, twenty),
       4,
       {{{4, 0}, {-1, 0}}, {{6, 0}, {1, 0}}}},
      {"col_off_centre",
       discs({disc({0, 0}, {1, 0}), disc({10, Rational(kRootTwo)}, {-1, 0})}, twenty),
       5 - half_root,
       {{{5 - half_root, 0}, {0, -1}}, {{5 + half_root, kRootTwo}, {0, 1}}}},
      {"col_speed",
       discs({disc({0, 0}, {2, 0}), disc({10, 0}, {-3, 0})}, twenty),
       1.6,
       {{{3.2, 0}, {-3, 0}}, {{5.2, 0}, {2, 0}}}},
      {"col_mass",
       discs({disc({0, 0}, {1, 0}, 1, 2), disc({10, 0}, {-1, 0}, 1, 3)}, twenty),
       4,
       {{{4, 0}, {-1.4, 0}}, {{6, 0}, {0.6, 0}}}},
      {"col_radii",
       discs({disc({0, 0}, {1, 0}, 2), disc({10, 0}, {-1, 0}, 3)}, twenty),
       2.5,
       {{{2.5, 0}, {-1, 0}}, {{7.5, 0}, {1, 0}}}},
  });
  const auto simple = make_log(discs({disc({6, 6}, {1, 0})}, box(0, 12)));
  expect_times("simple_simulation", *simple, {5, 15, 25, 35, 45, 55, 65, 75, 85, 95}, 1e-12);
}

// shohirose/hardsphere-molecular-dynamics, test/collision.cpp.
TEST(PublishedCases, SmallParticles) {
  const Rational radius(1, 100);
  const auto pair = [&](const ExactVector& first, const ExactVector& second) {
    return discs({disc({-1, 0}, first, radius), disc({1, 0}, second, radius)});
  };
  expect_hits({
      {"they collide", pair({1, 0}, {-1, 0}), 0.99, {{{-0.01, 0}, {-1, 0}}, {{0.01, 0}, {1, 0}}}},
      {"they do not", pair({0, 1}, {0, -1}), kNever},
      {"in parallel", pair({0, 1}, {0, 1}), kNever},
      {"in opposite directions", pair({-1, 0}, {1, 0}), kNever},
      {"have just collided",
       discs({disc({-radius, 0}, {-1, 0}, radius), disc({radius, 0}, {1, 0}, radius)}), kNever},
  });
}

// TheAlgorithms/Java, ElasticCollision2DTest.java; knoboid/particle-collision-system, test/units;
// loicmorvan/pinball, HalfPlaneColliderTests.cs.
TEST(PublishedCases, SingleHitsOfOtherPrograms) {
  const auto bodies = [](const ExactVector& first, const ExactVector& second, int mass = 1) {
    return discs({disc({0, 0}, first, kHalf, mass), disc({1, 0}, second, kHalf)});
  };
  const std::vector<Wall> floor = {{"plane", {0, 0}, {0, -1}}};
  expect_hits({
      {"Java: equal masses head-on", bodies({1, 0}, {-1, 0}), 0, {velocity(-1, 0), velocity(1, 0)}},
      {"Java: 2 to 1 head-on", bodies({2, 0}, {-1, 0}, 2), 0, {velocity(0, 0), velocity(3, 0)}},
      {"Java: apart", bodies({-1, 0}, {1, 0}), kNever},
      {"Java: one at rest", bodies({2, 0}, {0, 0}), 0, {velocity(0, 0), velocity(2, 0)}},
      {"knoboid: head-on", discs({disc({0, 0}, {1, 0}), disc({10, 0}, {-1, 0})}), 4},
      {"knoboid: slower", discs({disc({0, 0}, {1, 0}), disc({11, 0}, {-kHalf, 0})}), 6},
      {"knoboid: elasticCollision",
       discs({disc({10, 10}), disc({8, 10}, {1, 1})}),
       0,
       {velocity(1, 0), velocity(0, 1)}},
      {"pinball: half-plane", discs({disc({0, -1}, {0, 1}, Rational(1, 4))}, floor), 0.75},
  });
}

// knoboid/particle-collision-system, test/units/rbcd-test.js: walls of a box of side 10, and its
// corners, where two hits are at once. It says which walls are hit; these turn the velocity.
TEST(PublishedCases, WallsAndCornersOfABox) {
  struct Flight {
    std::array<int, 2> from;
    std::array<int, 2> velocity;
    double time;
    std::array<int, 2> hit;  ///< the sides, as directions
  };
  const std::vector<Flight> flights = {
      {{6, 4}, {1, 0}, 3, {1, 0}},     {{6, 4}, {-1, 0}, 5, {-1, 0}},
      {{6, 4}, {0, -1}, 3, {0, -1}},   {{6, 4}, {0, 1}, 5, {0, 1}},
      {{6, 4}, {1, 1}, 3, {1, 0}},     {{4, 6}, {1, 1}, 3, {0, 1}},
      {{7, 7}, {1, 1}, 2, {1, 1}},     {{7, 4}, {1, -1}, 2, {1, 0}},
      {{6, 3}, {1, -1}, 2, {0, -1}},   {{6, 4}, {1, -1}, 3, {1, -1}},
      {{3, 4}, {-1, -1}, 2, {-1, 0}},  {{5, 3}, {-1, -1}, 2, {0, -1}},
      {{3, 3}, {-1, -1}, 2, {-1, -1}}, {{3, 4}, {-1, 1}, 2, {-1, 0}},
      {{5, 7}, {-1, 1}, 2, {0, 1}},    {{7, 3}, {-1, 1}, 6, {-1, 1}},
  };
  for (const Flight& flight : flights) {
    const auto turned = [&](std::size_t axis) {
      return double(flight.hit.at(axis) == 0 ? flight.velocity.at(axis) : -flight.hit.at(axis));
    };
    const ExactVector from = {flight.from[0], flight.from[1]};
    const ExactVector along = {flight.velocity[0], flight.velocity[1]};
    expect_hit({"rbcd-test",
                discs({disc(from, along)}, box(0, 10)),
                flight.time,
                {velocity(turned(0), turned(1))}});
  }
}

/// Of that mass. There, a ball of mass 1 has the radius 1/2.
Body ball(int mass, const ExactVector& position, const ExactVector& velocity) {
  return disc(position, velocity, Rational(std::cbrt(mass) / 2), mass);
}

// jim-tooker/BallCollisionSimulator, tests/test_cases.py. It steps in time, by hundredths, so its
// times and places are late by up to one step; what it says of hits off the centre is then wrong.
TEST(PublishedCases, BallsThatLoseEnergy) {
  constexpr double kDigits = 5e-4;
  struct Loss {
    int number;
    System system;
    double time;
    std::vector<Motion> after;
    double energy_lost;
  };
  const auto facing = [](const Rational& e) {
    return discs({ball(1, {Rational(-3, 2), 0}, {1, 0}), ball(1, {Rational(3, 2), 0}, {-1, 0})}, {},
                 e);
  };
  const auto merged = [](double x, double y) { return std::vector(2, velocity(x, y)); };
  const ExactVector corner = {Rational(3, 2), Rational(3, 2)};
  const std::vector<Loss> cases = {
      {1, facing(1), 1, {{{-0.5, 0}, {-1, 0}}, {{0.5, 0}, {1, 0}}}, 0},
      {2,
       discs({ball(1, {Rational(-3, 2), 0}, {1, 1}), ball(1, {Rational(3, 2), 0}, {-1, 1})}),
       1,
       {{{-0.5, 1}, {-1, 1}}, {{0.5, 1}, {1, 1}}},
       0},
      {4,
       discs({ball(1, {-corner[0], -corner[1]}, {1, 1}), ball(1, corner, {-1, -1})}),
       1.15,
       {velocity(-1, -1), velocity(1, 1)},
       0},
      {6,
       discs({ball(1, {Rational(-3, 2), 0}, {1, 1}), ball(1, {Rational(3, 2), 0}, {0, 1})}),
       2,
       {{{0.5, 2}, {0, 1}}, {{1.5, 2}, {1, 1}}},
       0},
      {11,
       discs({ball(1, {0, 0}, {1, 0}), ball(1, {Rational(-5, 2), 0}, {2, 0})}),
       1.5,
       {{{1.5, 0}, {2, 0}}, {{0.5, 0}, {1, 0}}},
       0},
      {12,
       discs({ball(1, {-5, 0}, {2, 0}), ball(4, {5, 0}, {-1, 0})}),
       2.91,
       {velocity(-2.8, 0), velocity(0.2, 0)},
       0},
      {20, facing(0), 1, merged(0, 0), 1},
      {21, discs({ball(1, {-3, 0}, {1, 0}), ball(2, {3, 0}, {-1, 0})}, {}, 0), 2.44,
       merged(-0.333, 0), 1.333},
      {23, discs({ball(1, {Rational(-3, 2), 0}, {1, 0}), ball(1, {Rational(3, 2), 0}, {})}, {}, 0),
       2, merged(0.5, 0), 0.25},
      {25, discs({ball(1, {-5, -5}, {1, 1}), ball(2, {5, 5}, {-2, -2})}, {}, 0), 3.07,
       merged(-1, -1), 6},
      {28, discs({ball(1, {-5, 0}, {1, 0}), ball(1, {10, 0}, {-10, 0})}, {}, 0), 1.28,
       merged(-4.5, 0), 30.25},
      {29, discs({ball(1, {-10, 0}, {3, 0}), ball(10, {10, 0}, {-1, 0})}, {}, 0), 4.61,
       merged(-0.63636, 0), 7.2727},
      {30, discs({ball(1, {-10, 0}, {10, 0}), ball(5, {8, 0}, {-1, 0})}, {}, 0), 1.52,
       merged(0.8333, 0), 50.417},
      {31, facing(kHalf), 1, {velocity(-0.5, 0), velocity(0.5, 0)}, 0.75},
      {33,
       discs({ball(1, {-5, 0}, {2, 0}), ball(4, {5, 0}, {-1, 0})}, {}, Rational(1, 5)),
       2.91,
       {velocity(-0.88, 0), velocity(-0.28, 0)},
       3.456},
      {35,
       discs({ball(1, {-corner[0], -corner[1]}, {1, 1}), ball(1, corner, {-1, -1})}, {},
             Rational(7, 10)),
       1.15,
       {velocity(-0.7, -0.7), velocity(0.7, 0.7)},
       1.02},
  };
  for (const Loss& loss : cases) {
    SCOPED_TRACE(loss.number);
    expect_hit({"velocities", loss.system, kNotSaid, loss.after, kDigits, loss.energy_lost});
    expect_hit({"time", loss.system, loss.time, {}, 0.011});
  }
}

/// A disc that takes the place of a point among walls.
constexpr double kPoint = 0.125;

/// The square of side 1 around the origin with a disc in its middle, for points.
System sinai(double radius, const ExactVector& from, const ExactVector& along) {
  const Rational reach = kHalf + Rational(kPoint);
  return discs({disc(from, along, Rational(kPoint)), fixed({0, 0}, Rational(radius - kPoint))},
               box(-reach, reach));
}

// dpsanders/BilliardModels.jl, test/test_BilliardModels.jl.
TEST(PublishedCases, PointsAmongWallsAndDiscs) {
  const Rational point(kPoint);
  const double off = kPoint * kRootTwo;
  const Wall plane = {"plane", {Rational(off), 0}, {-1, -1}};
  const Wall finite = {"plane", {0, Rational(off)}, {1, -1}};
  System table = sinai(0.2, {Rational(1, 5), 0}, {1, 0});
  // Its disc has the radius 0.1, less than that of a body which fits here.
  table.bodies[1].size = Rational(1, 40);
  table.bodies[0].size = Rational(3, 40);
  table.walls = box(Rational(-23, 40), Rational(23, 40));
  System back = table;
  back.bodies[0].velocity[0] = -1;
  expect_hits({
      {"Disc", discs({disc({-2, 0}, {1, 0}, point), fixed({0, 0}, 1 - point)}), 1},
      {"Plane", discs({disc({-1, 0}, {1, 0}, point)}, {plane}), 1},
      {"Sinai_billiard: the wall", table, 0.3, {velocity(-1, 0)}},
      {"FinitePlane", discs({disc({kHalf, 0}, {0, 1}, point)}, {finite}), 0.5},
  });
  EXPECT_EQ(make_log(back)->collision(1).second, 1U) << "Sinai_billiard: the disc";
}

// DynamicalBilliards.jl, test/various_tests.jl: the mean time between hits in Sinai's billiard. It
// allows 0.1 of it.
TEST(PublishedCases, MeanTimeBetweenHitsInSinaisBilliard) {
  for (const double radius : {0.25, 0.35}) {
    const double said = std::numbers::pi * (1 - std::numbers::pi * radius * radius) /
                        (4 + 2 * std::numbers::pi * radius);
    const double angle = 0.1;
    const auto log = make_log(sinai(radius, {Rational(-0.4), Rational(-0.4)},
                                    {Rational(std::cos(angle)), Rational(std::sin(angle))}));
    constexpr int kTime = 20'000;
    EXPECT_NEAR(kTime / log->count_at(kTime).get_d(), said, 0.1 * said) << radius;
  }
}

/// Discs on a lattice, all with speed 1, in directions that follow each other by the golden angle.
System gas(int rows, const Rational& side) {
  std::vector<Body> bodies;
  for (int k = 0; k < rows * rows; ++k) {
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5));
    bodies.push_back(
        disc({side * (2 * (k % rows) + 1) / (2 * rows), side * (2 * (k / rows) + 1) / (2 * rows)},
             {Rational(std::cos(angle)), Rational(std::sin(angle))}));
  }
  return discs(bodies, box(0, side));
}

/// What walls have given to bodies of mass 1 until then.
double wall_impulse(const Log& log, const Rational& until) {
  double sum = 0;
  for (Integer k = 1; k <= log.count_at(until); ++k) {
    const Collision hit = log.collision(k);
    if (hit.second < log.system().bodies.size()) continue;
    sum += std::hypot(hit.first_after.velocity[0] - hit.first_before[0],
                      hit.first_after.velocity[1] - hit.first_before[1]);
  }
  return sum;
}

// tms-ninja/billiards, examples: maxwell-boltzmann.ipynb, equation-of-state.ipynb, and the mean
// speed of test_add_random_discs_temperature. All speeds are 1 at first, so kT is 1/2.
TEST(PublishedCases, GasOfDiscs) {
  constexpr double kTemperature = 0.5;
  constexpr int kRows = 20;
  constexpr int kSide = 200;
  constexpr int kTime = 6000;
  const System system = gas(kRows, kSide);
  const auto log = make_log(system, Rational(kTime));
  double speeds = 0;
  double slow = 0;
  int count = 0;
  for (int time = 500; time <= kTime; time += 50) {
    const State state = log->state_at(time);
    double energy = 0;
    for (const Motion& motion : state.bodies) {
      const double speed = std::hypot(motion.velocity[0], motion.velocity[1]);
      speeds += speed;
      energy += speed * speed / 2;
      if (speed <= 1) ++slow;
      ++count;
    }
    EXPECT_NEAR(energy, kRows * kRows * kTemperature, 1e-7);
  }
  EXPECT_NEAR(speeds / count, std::sqrt(std::numbers::pi * kTemperature / 2), 0.01);
  EXPECT_NEAR(slow / count, 1 - std::exp(-1 / (2 * kTemperature)), 0.01);
  // Centres stay off the walls by the radius: in such a small box, that is the room.
  constexpr double kRoom = kSide - 2;
  const double density = kRows * kRows / (kRoom * kRoom);
  const double cover = density * std::numbers::pi;
  const double root = std::sqrt(3) / std::numbers::pi;
  const double said =
      density * kTemperature *
      (1 + 2 * cover + (16.0 / 3 - 4 * root) * cover * cover +
       (16 - 36 * root + 80 / (std::numbers::pi * std::numbers::pi)) * cover * cover * cover);
  EXPECT_NEAR(wall_impulse(*log, kTime) / (4 * kRoom * kTime), said, 0.02 * said);
}

}  // namespace
}  // namespace piblocks
