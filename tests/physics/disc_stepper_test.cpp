#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/stepper.hpp"
#include "support/random_discs.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

constexpr double kUnit = 0x1p-53;

using Pair = std::pair<std::uint32_t, std::uint32_t>;

Pair pair_of(const SteppedCollision& step) { return {step.first, step.second}; }

/// All bodies as last reported.
class Motions {
 public:
  explicit Motions(const System& system) : system_(system) {
    for (const Body& body : system.bodies) {
      motions_.push_back({{body.position[0].get_d(), body.position[1].get_d()},
                          {body.velocity[0].get_d(), body.velocity[1].get_d()}});
      times_.push_back(0);
    }
  }

  void take(const SteppedCollision& step) {
    take(step.first, step.first_after, step.time.hi);
    if (step.second < motions_.size()) take(step.second, step.second_after, step.time.hi);
  }

  const Motion& operator[](std::size_t body) const { return motions_[body]; }

  std::array<double, 2> position_at(std::size_t body, double time) const {
    const Motion& motion = motions_[body];
    const double flight = time - times_[body];
    return {motion.position[0] + flight * motion.velocity[0],
            motion.position[1] + flight * motion.velocity[1]};
  }

  /// The least distance of any two bodies' edges.
  double least_gap(double time) const {
    double least = kForEver;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      const auto a = position_at(i, time);
      for (std::size_t j = i + 1; j < motions_.size(); ++j) {
        const auto b = position_at(j, time);
        const double reach = system_.bodies[i].size.get_d() + system_.bodies[j].size.get_d();
        least = std::min(least, std::hypot(b[0] - a[0], b[1] - a[1]) - reach);
      }
    }
    return least;
  }

 private:
  void take(std::size_t body, const Motion& motion, double time) {
    motions_[body] = motion;
    times_[body] = time;
  }

  const System& system_;
  std::vector<Motion> motions_ = {};
  std::vector<double> times_ = {};
};

double square(const std::array<double, 2>& v) { return v[0] * v[0] + v[1] * v[1]; }

TEST(DiscStepper, CollisionsKeepMomentumAndEnergy) {
  TracedRandom random(41);
  const System system = random_gas(random, 50);
  const auto stepper = make_disc_stepper(system);
  Motions motions(system);
  for (int k = 0; k < 5000; ++k) {
    const SteppedCollision step = *stepper->step();
    if (step.second >= system.bodies.size()) {
      ASSERT_EQ(square(step.first_after.velocity), square(motions[step.first].velocity));
      motions.take(step);
      continue;
    }
    const double m = system.bodies[step.first].mass->get_d();
    const double n = system.bodies[step.second].mass->get_d();
    const auto& u = motions[step.first].velocity;
    const auto& v = motions[step.second].velocity;
    const double energy = m * square(u) + n * square(v);
    const double after =
        m * square(step.first_after.velocity) + n * square(step.second_after.velocity);
    ASSERT_NEAR(after / energy, 1, 24 * kUnit);
    const double most = m * std::sqrt(square(u)) + n * std::sqrt(square(v));
    for (std::size_t axis : {0u, 1u}) {
      ASSERT_NEAR(m * step.first_after.velocity[axis] + n * step.second_after.velocity[axis],
                  m * u[axis] + n * v[axis], 24 * kUnit * most);
    }
    motions.take(step);
  }
}

TEST(DiscStepper, DiscsOverlapAtNoTime) {
  TracedRandom random(42);
  for (const std::uint32_t number : {5u, 40u}) {
    const System system = random_gas(random, number, 4);
    const auto stepper = make_disc_stepper(system);
    Motions motions(system);
    double last = 0;
    double least = kForEver;
    for (int k = 0; k < 1200; ++k) {
      const SteppedCollision step = *stepper->step();
      for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        least = std::min(least, motions.least_gap(last + share * (step.time.hi - last)));
      }
      last = step.time.hi;
      motions.take(step);
    }
    EXPECT_GT(least, -1e-12);
    EXPECT_LT(least, 1e-12);
  }
}

TEST(DiscStepper, HeadOnEqualDiscsExchangeTheirVelocities) {
  const System system{.dimensions = 2, .bodies = {{1, {0, 0}, {1, 0}}, {1, {5, 0}, {0, 0}}}};
  const auto stepper = make_disc_stepper(system);
  const auto step = stepper->step();
  ASSERT_TRUE(step);
  EXPECT_EQ(pair_of(*step), Pair(0, 1));
  EXPECT_EQ(step->time.hi, 3);
  EXPECT_EQ(step->first_after, (Motion{{3, 0}, {0, 0}}));
  EXPECT_EQ(step->second_after, (Motion{{5, 0}, {1, 0}}));
  EXPECT_FALSE(stepper->step());
  EXPECT_EQ(stepper->certain_until(), kForEver);
}

/// Centres at a 3-4-5 triangle: at contact the line of centres is (0.8, 0.6).
TEST(DiscStepper, ObliqueCollisionChangesVelocitiesAlongTheLineOfCentres) {
  const System system{.dimensions = 2, .bodies = {{3, {-4, 0}, {1, 0}, 3}, {1, {4, 3}, {0, 0}, 2}}};
  const auto stepper = make_disc_stepper(system);
  const auto step = stepper->step();
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->time.hi, 4, 8 * kUnit);
  EXPECT_NEAR(step->first_after.velocity[0], 1 - 0.5 * 0.64, 4 * kUnit);
  EXPECT_NEAR(step->first_after.velocity[1], -0.5 * 0.48, 4 * kUnit);
  EXPECT_NEAR(step->second_after.velocity[0], 1.5 * 0.64, 4 * kUnit);
  EXPECT_NEAR(step->second_after.velocity[1], 1.5 * 0.48, 4 * kUnit);
}

TEST(DiscStepper, SlantedWallReflects) {
  const System system{.dimensions = 2,
                      .bodies = {{1, {0, 3}, {0, -1}}},
                      .walls = {{"slope", {7, -7}, {Rational(1, 9), Rational(1, 9)}}}};
  const auto stepper = make_disc_stepper(system);
  const auto step = stepper->step();
  ASSERT_TRUE(step);
  EXPECT_EQ(pair_of(*step), Pair(0, 1));
  EXPECT_NEAR(step->time.hi, 3 - std::sqrt(2), 8 * kUnit);
  EXPECT_NEAR(step->first_after.velocity[0], 1, 4 * kUnit);
  EXPECT_NEAR(step->first_after.velocity[1], 0, 4 * kUnit);
  EXPECT_FALSE(stepper->step());
}

TEST(DiscStepper, RestitutionIsTheShareOfTheSpeedAtWhichDiscsPart) {
  System system{.dimensions = 2,
                .bodies = {{1, {0, 0}, {1, 0}}, {1, {5, 0}}, {1, {0, 9}, {0, 1}}},
                .walls = {{"top", {0, 20}, {0, -1}}},
                .restitution = Rational(1, 2),
                .wall_restitution = Rational(3, 4)};
  const auto speeds = [&] {
    const auto stepper = make_disc_stepper(system);
    const auto pair = stepper->step();
    const auto wall = stepper->step();
    EXPECT_EQ(stepper->certain_until(), kForEver);
    return std::array{pair->first_after.velocity[0], pair->second_after.velocity[0],
                      wall->first_after.velocity[1]};
  };
  EXPECT_EQ(speeds(), (std::array{0.25, 0.75, -0.75}));
  system.bodies[1].restitution = Rational(0);
  system.bodies[2].restitution = Rational(1);
  EXPECT_EQ(speeds(), (std::array{0.5, 0.5, -0.75}));
  system.walls[0].restitution = Rational(1, 4);
  EXPECT_EQ(speeds(), (std::array{0.5, 0.5, -0.25}));
}

/// (1 + e) w more than the mirrored velocity: of a wall, and of a disc of infinite mass.
TEST(DiscStepper, ImmovableBodiesPushDiscs) {
  System system{.dimensions = 2,
                .bodies = {{1, {0, 0}}},
                .walls = {{"piston", {-9, 0}, {1, 0}, {2, 0}}},
                .wall_restitution = Rational(1, 2)};
  const auto pushed = make_disc_stepper(system)->step();
  EXPECT_EQ(pair_of(*pushed), Pair(0, 1));
  EXPECT_EQ(pushed->time.hi, 4);
  EXPECT_EQ(pushed->first_after, (Motion{{0, 0}, {3, 0}}));
  system.bodies = {{std::nullopt, {0, 20}, {0, -1}}, {1, {0, 12}}};
  system.walls.clear();
  const auto struck = make_disc_stepper(system)->step();
  EXPECT_EQ(struck->time.hi, 6);
  EXPECT_EQ(struck->first_after, (Motion{{0, 14}, {0, -1}}));
  EXPECT_EQ(struck->second_after, (Motion{{0, 12}, {0, -1.5}}));
}

/// Just before each hit at the piston the free length times the closing speed is the same.
TEST(DiscStepper, APistonKeepsTheAdiabaticInvariant) {
  const System system{
      .dimensions = 2,
      .bodies = {{1, {5, 0}, {1, 0}, Rational(1, 2)}},
      .walls = {{"left", {0, 0}, {1, 0}}, {"right", {10, 0}, {-1, 0}, {Rational(-1, 10), 0}}}};
  const auto stepper = make_disc_stepper(system);
  double speed = 1;
  for (int k = 0; k < 20; ++k) {
    const SteppedCollision step = *stepper->step();
    EXPECT_NEAR((9 - step.time.hi / 10) * (speed + 0.1), 9.45, 1e-12);
    speed = -step.first_after.velocity[0];
    EXPECT_NEAR(speed, 1 + 0.2 * (k + 1), 1e-13);
    stepper->step();
  }
  EXPECT_EQ(stepper->certain_until(), kForEver);
}

TEST(DiscStepper, ImmovableDiscStays) {
  const System system{
      .dimensions = 2,
      .bodies = {{std::nullopt, {0, 0}}, {1, {5, 0}, {-1, 0}}, {std::nullopt, {9, 0}}}};
  const auto stepper = make_disc_stepper(system);
  for (int k = 0; k < 10; ++k) {
    const auto step = stepper->step();
    ASSERT_TRUE(step);
    EXPECT_EQ(pair_of(*step), k % 2 == 0 ? Pair(0, 1) : Pair(1, 2));
    EXPECT_EQ(step->time.hi, 3 + 5 * k);
    const Motion& still = k % 2 == 0 ? step->first_after : step->second_after;
    EXPECT_EQ(still, (Motion{{k % 2 == 0 ? 0.0 : 9.0, 0}, {0, 0}}));
  }
}

TEST(DiscStepper, OneDiscInABoxIsCertainForLong) {
  const System system{.dimensions = 2,
                      .bodies = {{1, {Rational(3, 2), 2}, {1, Rational(1, 3)}}},
                      .walls = box(4, 5)};
  const auto stepper = make_disc_stepper(system);
  int across = 0;
  int up = 0;
  for (int k = 0; k < 1000; ++k) {
    const auto step = stepper->step();
    ASSERT_TRUE(step);
    const double expected = step->second <= 2 ? 1.5 + 2 * across++ : 6.0 + 9 * up++;
    ASSERT_NEAR(step->time.hi, expected, 1e-9);
  }
  // Even where it meets both walls at once.
  EXPECT_EQ(stepper->certain_until(), kForEver);
}

TEST(DiscStepper, DiscInACornerMeetsTheLowerWallFirst) {
  const System system{.dimensions = 2, .bodies = {{1, {5, 5}, {-1, -1}}}, .walls = box(10, 10)};
  const auto stepper = make_disc_stepper(system);
  for (std::uint32_t k = 0; k < 10; ++k) {
    for (const std::uint32_t wall : {1u, 3u}) {
      const auto step = stepper->step();
      ASSERT_TRUE(step);
      EXPECT_EQ(pair_of(*step), Pair(0, wall + k % 2));
      EXPECT_EQ(step->time.hi, 4 + 8 * k);
    }
  }
  EXPECT_EQ(stepper->certain_until(), kForEver);
}

TEST(DiscStepper, NothingHappensToDiscsAtRest) {
  System system{.dimensions = 2, .bodies = {{1, {0, 0}}, {2, {2, 0}}, {1, {7, 1}}}};
  system.walls = {{"touching", {0, -1}, {0, 1}}};
  const auto stepper = make_disc_stepper(system);
  EXPECT_FALSE(stepper->step());
  EXPECT_FALSE(stepper->step());
  EXPECT_EQ(stepper->certain_until(), kForEver);
  EXPECT_FALSE(make_disc_stepper(System{.dimensions = 2})->step());
}

TEST(DiscStepper, TouchingDiscsThatApproachCollideAtOnce) {
  const System system{.dimensions = 2, .bodies = {{1, {0, 0}, {1, 0}}, {1, {2, 0}, {-1, 0}}}};
  const auto stepper = make_disc_stepper(system);
  const auto step = stepper->step();
  ASSERT_TRUE(step);
  EXPECT_EQ(step->time.hi, 0);
  EXPECT_EQ(step->first_after.velocity[0], -1);
  EXPECT_FALSE(stepper->step());
}

TEST(DiscStepper, TouchingDiscsThatPartDoNotCollide) {
  const System system{.dimensions = 2, .bodies = {{1, {0, 0}, {-1, 0}}, {1, {2, 0}, {1, 0}}}};
  const auto stepper = make_disc_stepper(system);
  EXPECT_FALSE(stepper->step());
  EXPECT_EQ(stepper->certain_until(), kForEver);
}

TEST(DiscStepper, TouchingDiscsAreCertainEvenWhenStruck) {
  const System system{.dimensions = 2,
                      .bodies = {{1, {0, 0}, {2, 0}}, {1, {5, 0}}, {1, {7, 0}}, {1, {9, 0}}}};
  const auto stepper = make_disc_stepper(system);
  EXPECT_EQ(stepper->certain_until(), kForEver);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const auto step = stepper->step();
    ASSERT_TRUE(step);
    EXPECT_EQ(pair_of(*step), Pair(k, k + 1));
    EXPECT_EQ(step->time.hi, 1.5);
  }
  EXPECT_FALSE(stepper->step());
  EXPECT_GT(stepper->certain_until(), 1e12);
}

/// One at a time, (1, 4) would send 4 into (2, 4). At once, each of both sends back the other.
TEST(DiscStepper, SimultaneousCollisionsAreInTheOrderOfPairs) {
  const System system{.dimensions = 2,
                      .bodies = {{1, {20, 0}, {1, 0}},
                                 {1, {0, 0}, {1, 0}},
                                 {1, {10, 0}, {-1, 0}},
                                 {1, {26, 0}, {-1, 0}},
                                 {1, {5, 0}}},
                      .walls = {{"right", {30, 0}, {-1, 0}}}};
  const auto stepper = make_disc_stepper(system);
  std::vector<Pair> pairs;
  for (int k = 0; k < 3; ++k) pairs.push_back(pair_of(*stepper->step()));
  EXPECT_EQ(pairs[0], Pair(0, 3));  // at 2
  EXPECT_EQ(pairs[1], Pair(1, 4));  // at 3, before (2, 4)
  EXPECT_EQ(pairs[2], Pair(2, 4));
  EXPECT_EQ(stepper->certain_until(), kForEver);
}

TEST(DiscStepper, WallsComeAfterDiscs) {
  const System system{.dimensions = 2,
                      .bodies = {{1, {0, 0}, {0, 0}}, {1, {5, 0}, {-1, -1}}},
                      .walls = {{"bottom", {0, -4}, {0, 1}}, {"left", {1, 0}, {1, 0}}}};
  System corner = system;
  corner.bodies[0].position = {20, 20};
  const auto stepper = make_disc_stepper(corner);
  EXPECT_EQ(pair_of(*stepper->step()), Pair(1, 2));
  EXPECT_EQ(pair_of(*stepper->step()), Pair(1, 3));
  EXPECT_EQ(stepper->certain_until(), kForEver);
}

TEST(DiscStepper, PowersOfTwoScaleEverythingExactly) {
  TracedRandom random(43);
  const System system = random_gas(random, 30);
  System scaled = system;
  const Rational length = Rational(1) << 300;
  const Rational speed = Rational(1) >> 200;
  for (Body& body : scaled.bodies) {
    body.size *= length;
    *body.mass *= speed;
    for (Rational& part : body.position) part *= length;
    for (Rational& part : body.velocity) part *= speed;
  }
  for (Wall& wall : scaled.walls) {
    for (Rational& part : wall.point) part *= length;
  }
  const auto plain = make_disc_stepper(system);
  const auto large = make_disc_stepper(scaled);
  for (int k = 0; k < 1000; ++k) {
    const SteppedCollision a = *plain->step();
    const SteppedCollision b = *large->step();
    ASSERT_EQ(pair_of(a), pair_of(b));
    ASSERT_EQ(std::ldexp(a.time.hi, 500), b.time.hi);
    ASSERT_EQ(std::ldexp(a.first_after.position[0], 300), b.first_after.position[0]);
    ASSERT_EQ(std::ldexp(a.first_after.velocity[1], -200), b.first_after.velocity[1]);
  }
  EXPECT_EQ(std::ldexp(plain->certain_until(), 500), large->certain_until());
}

TEST(DiscStepper, HugeAndTinyNumbersAreAsGoodAsOthers) {
  for (const Rational& scale : {power(10, 150), Rational(1 / power(10, 150))}) {
    System system{.dimensions = 2,
                  .bodies = {{scale, {-4, 0}, {1, 0}, 3}, {3 * scale, {4, 3}, {-1, 0}, 2}}};
    for (Body& body : system.bodies) {
      body.size *= scale;
      for (Rational& part : body.position) part *= scale;
      for (Rational& part : body.velocity) part *= scale;
    }
    const auto stepper = make_disc_stepper(system);
    const auto step = stepper->step();
    ASSERT_TRUE(step);
    EXPECT_NEAR(step->time.hi, 2, 1e-14);
    const double unit = scale.get_d();
    EXPECT_NEAR(step->first_after.velocity[0] / unit, 1 - 2 * 0.75 * 2 * 0.64, 1e-14);
    EXPECT_FALSE(stepper->step());
    EXPECT_EQ(stepper->certain_until(), kForEver);
  }
}

TEST(DiscStepper, NumbersTooFarApartAreRejected) {
  System system{.dimensions = 2, .bodies = {{1, {0, 0}, {1, 0}}, {1, {5, 0}}}};
  system.bodies[1].mass = 1 / power(10, 300);
  EXPECT_THROW(make_disc_stepper(system), SimulationError);
  system.bodies[1].mass = 1;
  system.bodies[1].size = 1 / power(10, 200);
  EXPECT_THROW(make_disc_stepper(system), SimulationError);
  system.bodies[1].size = 1;
  system.bodies[1].position[0] = power(10, 200);
  EXPECT_THROW(make_disc_stepper(system), SimulationError);
}

}  // namespace
}  // namespace piblocks
