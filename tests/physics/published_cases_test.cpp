// What other public programs state in their tests and examples.
#include "physics/published_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <piblocks/log.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/rounded.hpp"

namespace piblocks {
namespace {

std::vector<Wall> box(const Rational& low, const Rational& high) {
  return {{"left", {low, 0}, {1, 0}},
          {"right", {high, 0}, {-1, 0}},
          {"bottom", {0, low}, {0, 1}},
          {"top", {0, high}, {0, -1}}};
}

TEST(PublishedCases, HardSpheres) {
  const Source program("HardSphereDynamics.jl, test/runtests.jl");
  expect_hits({
      {"FixedPlane", discs({disc({0, 0}, {1, 0}, 2)}, {{"plane", {10, 0}, {-1, 0}}}), 8},
      {"two MovableBalls, glancing",
       discs({disc({0, 0}, {1, 0}), disc({10, kHalf}, {-1, 0})}),
       4.031754163448146,
       {velocity(-0.8750000000000002, -0.48412291827592724)}},
  });
}

// The discs are smooth.
TEST(PublishedCases, SmoothDiscsInABox) {
  const Source program("tms-ninja/billiards, testing/test_billiards.py");
  const std::vector<Wall> ten = box(0, 10);
  const std::vector<Wall> twenty = box(-20, 20);
  std::vector<Wall> diagonal = box(-10, 10);
  diagonal.push_back({"diagonal", {0, 0}, {1, -1}});
  const double half_root = std::numbers::sqrt2 / 2;
  expect_hits({
      {"wall_col_vertical", discs({disc({3, 3}, {-1, 1})}, ten), 2, {{{1, 5}, {1, 1}}}},
      {"wall_col_horizontal", discs({disc({3, 7}, {1, 1})}, ten), 2, {{{5, 9}, {1, -1}}}},
      {"wall_col_diagonal",
       discs({disc({3, 0}, {0, 1})}, diagonal),
       3 - std::numbers::sqrt2,
       {{{3, 3 - std::numbers::sqrt2}, {1, 0}}}},
      {"col_vertical",
       discs({disc({3, 0}, {0, 1}), disc({3, 10}, {0, -1})}, twenty),
       4,
       {{{3, 4}, {0, -1}}, {{3, 6}, {0, 1}}}},
      {"col_horizontally",
       discs({disc({0, 0}, {1, 0}), disc({10, 0}, {-1, 0})}, twenty),
       4,
       {{{4, 0}, {-1, 0}}, {{6, 0}, {1, 0}}}},
      {"col_off_centre",
       discs({disc({0, 0}, {1, 0}), disc({10, Rational(std::numbers::sqrt2)}, {-1, 0})}, twenty),
       5 - half_root,
       {{{5 - half_root, 0}, {0, -1}}, {{5 + half_root, std::numbers::sqrt2}, {0, 1}}}},
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

TEST(PublishedCases, SmallParticles) {
  const Source program("shohirose/hardsphere-molecular-dynamics, test/collision.cpp");
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

TEST(PublishedCases, SingleHitsOfOtherPrograms) {
  const Source program(
      "TheAlgorithms/Java, ElasticCollision2DTest.java; knoboid/particle-collision-system, "
      "test/units; "
      "loicmorvan/pinball, HalfPlaneColliderTests.cs");
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

// Walls of a box of side 10, and its corners, where two hits are at once. The source says which
// walls are hit; these turn the velocity.
TEST(PublishedCases, WallsAndCornersOfABox) {
  const Source program("knoboid/particle-collision-system, test/units/rbcd-test.js");
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
    const Source source(fmt::format("from {} along {}", fmt::join(flight.from, " "),
                                    fmt::join(flight.velocity, " ")));
    expect_hit({"box",
                discs({disc(from, along)}, box(0, 10)),
                flight.time,
                {velocity(turned(0), turned(1))}});
  }
}

/// Of that mass. There, a ball of mass 1 has the radius 1/2.
Body ball(int mass, const ExactVector& position, const ExactVector& velocity) {
  return disc(position, velocity, Rational(std::cbrt(mass) / 2), mass);
}

// The source steps in time, by hundredths, so that its times and places are late by up to one step;
// what it says of hits off the centre is then wrong.
TEST(PublishedCases, BallsThatLoseEnergy) {
  const Source program("jim-tooker/BallCollisionSimulator, tests/test_cases.py");
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
    const Source source(fmt::format("{}", loss.number));
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

TEST(PublishedCases, PointsAmongWallsAndDiscs) {
  const Source program("dpsanders/BilliardModels.jl, test/test_BilliardModels.jl");
  const Rational point(kPoint);
  const double off = kPoint * std::numbers::sqrt2;
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

// The source allows a tenth of the value.
TEST(PublishedCases, MeanTimeBetweenHitsInSinaisBilliard) {
  const Source program("DynamicalBilliards.jl, test/various_tests.jl");
  for (const double radius : {0.25, 0.35}) {
    const double said = std::numbers::pi * (1 - std::numbers::pi * radius * radius) /
                        (4 + 2 * std::numbers::pi * radius);
    const double angle = 0.1;
    const auto log =
        make_log(sinai(radius, {Rational(-0.4), Rational(-0.4)},
                       {Rational(rounded::cos(angle)), Rational(rounded::sin(angle))}));
    constexpr int kTime = 20'000;
    const Source source(fmt::format("a disc of radius {}, {} units of time", radius, kTime));
    expect_said("mean time between hits", said, kTime / log->count_at(kTime).get_d(), 0.1 * said);
  }
}

/// Discs on a lattice, all with speed 1, in directions that follow each other by the golden angle.
System gas(int rows, const Rational& side) {
  std::vector<Body> bodies;
  for (int k = 0; k < rows * rows; ++k) {
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5));
    bodies.push_back(
        disc({side * (2 * (k % rows) + 1) / (2 * rows), side * (2 * (k / rows) + 1) / (2 * rows)},
             {Rational(rounded::cos(angle)), Rational(rounded::sin(angle))}));
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

// The mean speed is that of test_add_random_discs_temperature. All speeds are 1 at first, so kT is
// 1/2.
TEST(PublishedCases, GasOfDiscs) {
  const Source program(
      "tms-ninja/billiards, examples: maxwell-boltzmann.ipynb, equation-of-state.ipynb");
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
  const Source source(fmt::format("{} discs until {}", kRows * kRows, kTime));
  expect_said("mean speed", std::sqrt(std::numbers::pi * kTemperature / 2), speeds / count, 0.01);
  expect_said("share of speeds up to 1", 1 - std::exp(-1 / (2 * kTemperature)), slow / count, 0.01);
  // Centres stay off the walls by the radius: in such a small box, that is the room.
  constexpr double kRoom = kSide - 2;
  const double density = kRows * kRows / (kRoom * kRoom);
  const double cover = density * std::numbers::pi;
  const double root = std::sqrt(3) / std::numbers::pi;
  const double said =
      density * kTemperature *
      (1 + 2 * cover + (16.0 / 3 - 4 * root) * cover * cover +
       (16 - 36 * root + 80 / (std::numbers::pi * std::numbers::pi)) * cover * cover * cover);
  expect_said("pressure", said, wall_impulse(*log, kTime) / (4 * kRoom * kTime), 0.02 * said);
}

}  // namespace
}  // namespace piblocks
