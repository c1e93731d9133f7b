// Several contacts at one instant: hits that are symmetric, struck rows, racks and corners.
#include <gtest/gtest.h>
#include <piblocks/log.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "physics/stepper.hpp"
#include "support/random_discs.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

struct Outcome {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs = {};
  std::vector<double> times = {};
  std::vector<std::array<double, 2>> velocities = {};  ///< at the end
  double certain_until = kForEver;
};

Outcome run_of(const System& system, std::size_t most = 1000) {
  Outcome run;
  for (const Body& body : system.bodies) {
    run.velocities.push_back({body.velocity[0].get_d(), body.velocity[1].get_d()});
  }
  const auto stepper = make_disc_stepper(system);
  while (run.pairs.size() < most) {
    const auto step = stepper->step();
    if (!step) break;
    run.pairs.emplace_back(step->first, step->second);
    run.times.push_back(step->time.hi);
    run.velocities[step->first] = step->first_after.velocity;
    if (step->second < system.bodies.size()) {
      run.velocities[step->second] = step->second_after.velocity;
    }
  }
  run.certain_until = stepper->certain_until();
  return run;
}

std::array<double, 2> momentum_of(const System& system, const Outcome& run) {
  std::array<double, 2> sum = {};
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    for (const std::size_t axis : {0U, 1U}) {
      sum.at(axis) += system.bodies[i].mass->get_d() * run.velocities[i].at(axis);
    }
  }
  return sum;
}

double energy_of(const System& system, const Outcome& run) {
  double sum = 0;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const auto& v = run.velocities[i];
    if (system.bodies[i].mass) sum += system.bodies[i].mass->get_d() * (v[0] * v[0] + v[1] * v[1]);
  }
  return sum;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// The sides are 3, 4 and 5, so all numbers of the hit are rational.
TEST(DiscContacts, OneDiscHitsTwoAtOnce) {
  const System system{
      .dimensions = 2,
      .bodies = {{1, {-4, 0}, {1, 0}}, {1, {0, Rational(6, 5)}}, {1, {0, Rational(-6, 5)}}}};
  const Outcome run = run_of(system);
  EXPECT_EQ(run.pairs, (Pairs{{0, 1}, {0, 2}}));
  EXPECT_EQ(run.certain_until, kForEver);
  EXPECT_NEAR(run.velocities[0][0], -0.28 / 2.28, 1e-15);
  EXPECT_NEAR(run.velocities[0][1], 0, 1e-15);
  EXPECT_NEAR(run.velocities[1][0], 1.28 / 2.28, 1e-15);
  EXPECT_NEAR(run.velocities[1][1], 0.96 / 2.28, 1e-15);
  EXPECT_NEAR(run.velocities[2][1], -0.96 / 2.28, 1e-15);
  System in_order = system;
  in_order.contacts = Contacts::in_order;
  EXPECT_NE(run_of(in_order).velocities[0][1], 0);
}

/// The last one of a struck row leaves with the speed of the first.
TEST(DiscContacts, StruckRowIsNewtonsCradle) {
  System system{.dimensions = 2, .bodies = {{1, {0, 0}, {1, 0}}}};
  for (int k = 0; k < 5; ++k) system.bodies.push_back({1, {5 + 2 * k, 0}});
  const Outcome run = run_of(system);
  EXPECT_EQ(run.pairs, (Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}}));
  // Two that rest might truly drift towards each other by what rounding leaves in doubt.
  EXPECT_GT(run.certain_until, 1e12);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(run.velocities[k][0], k == 5 ? 1 : 0) << k;
}

TEST(DiscContacts, DiscOnTheFloorIsHitHeadOn) {
  const System system{.dimensions = 2,
                      .bodies = {{1, {0, 1}}, {1, {0, 6}, {0, -1}}},
                      .walls = {{"floor", {0, 0}, {0, 1}}}};
  const Outcome run = run_of(system);
  EXPECT_EQ(run.pairs, (Pairs{{0, 1}, {0, 2}, {0, 1}}));
  EXPECT_EQ(run.times, (std::vector<double>{3, 3, 3}));
  EXPECT_EQ(run.velocities[1][1], 1);
  EXPECT_EQ(run.certain_until, kForEver);
}

/// The disc rests in contact with the one that it then hits.
TEST(DiscContacts, ApproachFromRestContactIsCertain) {
  const System system{.dimensions = 2,
                      .bodies = {{1, {-5, 0}, {1, 0}}, {1, {0, 0}}, {1, {2, 0}}, {1, {9, 0}}}};
  const Outcome run = run_of(system);
  EXPECT_EQ(run.pairs, (Pairs{{0, 1}, {1, 2}, {2, 3}}));
  EXPECT_GT(run.certain_until, 1e12);
}

/// Discs on a circle fly to one in its middle. Everything keeps the symmetry.
TEST(DiscContacts, HitsFromAllSidesKeepTheirSymmetry) {
  for (int number = 2; number <= 6; ++number) {
    for (const Rational& restitution : {Rational(1), Rational(4, 5)}) {
      System system{.dimensions = 2, .bodies = {{3, {0, 0}}}, .restitution = restitution};
      for (int k = 0; k < number; ++k) {
        const double angle = 2 * std::numbers::pi * k / number + 0.3;
        const Rational x(std::cos(angle));
        const Rational y(std::sin(angle));
        system.bodies.push_back({1, {5 * x, 5 * y}, {-x, -y}, Rational(9, 10)});
      }
      const Outcome run = run_of(system);
      EXPECT_NEAR(run.velocities[0][0], 0, 1e-14) << number;
      EXPECT_NEAR(run.velocities[0][1], 0, 1e-14) << number;
      for (std::size_t k = 1; k <= std::size_t(number); ++k) {
        const auto& v = run.velocities[k];
        const auto& d = system.bodies[k].velocity;
        EXPECT_NEAR(v[0] * d[1].get_d() - v[1] * d[0].get_d(), 0, 1e-14) << number;
        EXPECT_NEAR(std::hypot(v[0], v[1]), restitution.get_d(), 1e-14) << number;
      }
    }
  }
}

/// Rows of 1, 2, 3, … unit discs, their centres in doubles, and one that hits the first.
System rack(int rows, const Rational& restitution) {
  System system{.dimensions = 2, .bodies = {{1, {-6, 0}, {1, 0}}}, .restitution = restitution};
  for (int row = 0; row < rows; ++row) {
    for (int k = 0; k <= row; ++k) {
      system.bodies.push_back({1, {Rational(std::sqrt(3) * row), 2 * k - row}});
    }
  }
  return system;
}

TEST(DiscContacts, RackBreaksSymmetrically) {
  for (const Rational& restitution : {Rational(1), Rational(4, 5)}) {
    const System system = rack(5, restitution);
    ASSERT_TRUE(problems_of(system).empty());
    const Outcome run = run_of(system);
    EXPECT_GT(run.certain_until, 4);
    EXPECT_NEAR(run.velocities[0][1], 0, 1e-14);
    std::size_t first = 1;
    double momentum = run.velocities[0][0];
    for (std::size_t row = 0; row < 5; first += ++row) {
      for (std::size_t k = 0; k <= row; ++k) {
        const auto& v = run.velocities[first + k];
        const auto& mirrored = run.velocities[first + row - k];
        EXPECT_NEAR(v[0], mirrored[0], 1e-13) << row << ' ' << k;
        EXPECT_NEAR(v[1], -mirrored[1], 1e-13) << row << ' ' << k;
        momentum += v[0];
      }
    }
    EXPECT_NEAR(momentum, 1, 1e-13);
    const double energy = energy_of(system, run);
    EXPECT_TRUE(restitution == 1 ? std::abs(energy - 1) < 1e-13 : energy < 1) << energy;
  }
}

/// By the rule it sticks together after some stages, and flies on.
TEST(DiscContacts, ARowThatSticksGoesOn) {
  const System row{.dimensions = 2,
                   .bodies = {{1, {-4, 0}, {1, 0}}, {1, {0, 0}}, {1, {2, 0}}},
                   .restitution = 0};
  const auto log = make_log(row);
  EXPECT_FALSE(log->collapse({}));
  EXPECT_NEAR(log->state_at(10).bodies[2].velocity[0], 1.0 / 3, 1e-11);
}

/// Clusters of a hexagonal lattice, struck by one disc: energy, momentum, and no contact
/// approaches.
TEST(DiscContacts, ClustersKeepWhatCollisionsKeep) {
  TracedRandom random(44);
  for (int trial = 0; trial < 200; ++trial) {
    System system{.dimensions = 2, .restitution = trial % 2 == 0 ? Rational(1) : Rational(3, 5)};
    for (int row = 0; row < 3; ++row) {
      for (int k = 0; k < 4; ++k) {
        if (random.integer(0, 2) == 0) continue;
        system.bodies.push_back({random.integer(1, 5),
                                 {Rational(std::sqrt(3) * row), 2 * k + row % 2},
                                 {random.rational(-1, 1, 4), random.rational(-1, 1, 4)}});
      }
    }
    if (system.bodies.size() < 2) continue;
    const double before = energy_of(system, run_of(system, 0));
    const auto stepper = make_disc_stepper(system);
    Outcome run = run_of(system, 0);
    const std::array<double, 2> momentum = momentum_of(system, run);
    while (const auto step = stepper->step()) {
      if (step->time.hi > 0) break;
      run.velocities[step->first] = step->first_after.velocity;
      run.velocities[step->second] = step->second_after.velocity;
    }
    const double after = energy_of(system, run);
    for (const std::size_t axis : {0U, 1U}) {
      EXPECT_NEAR(momentum_of(system, run).at(axis), momentum.at(axis), 1e-12) << trial;
    }
    EXPECT_LE(after, before + 1e-12) << trial;
    EXPECT_GE(after, trial % 2 == 0 ? before - 1e-12 : 0) << trial;
    for (std::size_t i = 0; i < system.bodies.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double x =
            system.bodies[j].position[0].get_d() - system.bodies[i].position[0].get_d();
        const double y =
            system.bodies[j].position[1].get_d() - system.bodies[i].position[1].get_d();
        if (std::hypot(x, y) > 2 + 1e-9) continue;
        const auto& a = run.velocities[i];
        const auto& b = run.velocities[j];
        EXPECT_LT((a[0] - b[0]) * x + (a[1] - b[1]) * y, 1e-11) << trial;
      }
    }
  }
}

/// Collisions that lose energy cool a gas, and gather it in clusters.
TEST(DiscContacts, GranularGasCools) {
  TracedRandom random(45);
  System system = random_gas(random, 300);
  system.restitution = Rational(4, 5);
  Outcome run = run_of(system, 0);
  const auto stepper = make_disc_stepper(system);
  const double first = energy_of(system, run);
  double energy = first;
  for (int k = 0; k < 3000; ++k) {
    const auto step = stepper->step();
    ASSERT_TRUE(step);
    run.velocities[step->first] = step->first_after.velocity;
    const bool is_wall = step->second >= system.bodies.size();
    if (!is_wall) run.velocities[step->second] = step->second_after.velocity;
    const double next = energy_of(system, run);
    ASSERT_LE(next, energy * (1 + 1e-12));
    energy = next;
  }
  EXPECT_LT(energy, first / 4);
}

}  // namespace
}  // namespace piblocks
