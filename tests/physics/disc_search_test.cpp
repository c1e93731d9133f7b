#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/event_simulator.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/discs/stepper.hpp"
#include "support/random_discs.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

/// To the last bit.
void expect_same_steps(const System& system, int number) {
  discs::Stepper fast(system);
  discs::Stepper plain(system, discs::Search::all_pairs);
  for (int k = 0; k < number; ++k) {
    const auto a = fast.step();
    const auto b = plain.step();
    ASSERT_EQ(a.has_value(), b.has_value()) << "collision " << k;
    if (!a) return;
    ASSERT_EQ(a->time, b->time) << "collision " << k;
    ASSERT_EQ(a->first, b->first) << "collision " << k;
    ASSERT_EQ(a->second, b->second) << "collision " << k;
    ASSERT_EQ(a->first_after, b->first_after) << "collision " << k;
    ASSERT_EQ(a->second_after, b->second_after) << "collision " << k;
  }
}

/// Makes room in the middle for a disc.
void put_into(System& system, const Body& large) {
  std::erase_if(system.bodies, [&](const Body& body) {
    const Rational x = body.position[0] - large.position[0];
    const Rational y = body.position[1] - large.position[1];
    const Rational reach = body.size + large.size;
    return x * x + y * y <= reach * reach;
  });
  system.bodies.insert(system.bodies.begin() + std::ssize(system.bodies) / 2, large);
}

TEST(DiscSearch, CellsFindWhatAllPairsFind) {
  TracedRandom random(31);
  for (const std::uint32_t number : {17u, 40u, 150u}) {
    expect_same_steps(random_gas(random, number), 4000);
  }
  expect_same_steps(random_gas(random, 300, 10), 4000);
}

TEST(DiscSearch, LargeDiscsAreFoundInTheirZones) {
  TracedRandom random(32);
  System system = random_gas(random, 400);
  put_into(system, {Rational(200), {25, 25}, {Rational(1, 3), Rational(-1, 7)}, 9});
  put_into(system, {std::nullopt, {10, 40}, {0, 0}, 6});
  put_into(system, {Rational(50), {40, 40}, {Rational(-1), Rational(-1)}, 5});
  expect_same_steps(system, 6000);
  system.walls.clear();
  expect_same_steps(system, 6000);
}

TEST(DiscSearch, DiscsThatLeaveTheGridAreFound) {
  TracedRandom random(33);
  System system = random_gas(random, 100);
  system.walls = {{"left", {-300, 0}, {1, 0}},
                  {"right", {500, 0}, {-1, 0}},
                  {"bottom", {0, -200}, {1, 20}},
                  {"top", {0, 100}, {3, -20}}};
  expect_same_steps(system, 6000);
}

TEST(DiscSearch, DiscsAtRestAndImmovableOnesAreFound) {
  TracedRandom random(34);
  System system = random_gas(random, 120);
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    if (i % 7 == 3) system.bodies[i].mass.reset();
    if (i % 10 != 0 || i % 7 == 3) system.bodies[i].velocity = {0, 0};
  }
  expect_same_steps(system, 4000);
}

/// A piston, and immovable discs that fly: a small one from cell to cell, a large one with a zone.
TEST(DiscSearch, MovingImmovableDiscsAreFound) {
  TracedRandom random(38);
  System system = random_gas(random, 200);
  system.walls[1].velocity = {Rational(-1, 20), 0};
  system.restitution = Rational(4, 5);
  system.bodies[30].mass.reset();
  system.bodies[30].velocity = {Rational(1, 3), Rational(1, 5)};
  expect_same_steps(system, 3000);
  put_into(system, {std::nullopt, {20, 20}, {Rational(-1, 4), Rational(1, 7)}, 6});
  expect_same_steps(system, 3000);
}

TEST(DiscSearch, OrderOfListingDoesNotMatter) {
  TracedRandom random(35);
  const System system = random_gas(random, 60);
  std::vector<std::uint32_t> places(system.bodies.size());
  std::iota(places.begin(), places.end(), 0u);
  for (std::size_t i = places.size(); --i > 0;) {
    std::swap(places[i],
              places[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(i)))]);
  }
  System shuffled = system;
  for (std::size_t i = 0; i < places.size(); ++i) shuffled.bodies[places[i]] = system.bodies[i];
  const auto ordered_stepper = make_disc_stepper(system);
  const auto shuffled_stepper = make_disc_stepper(shuffled);
  for (int k = 0; k < 3000; ++k) {
    const SteppedCollision a = *ordered_stepper->step();
    SteppedCollision b = *shuffled_stepper->step();
    ASSERT_EQ(a.time, b.time) << "collision " << k;
    if (a.second >= places.size()) {
      ASSERT_EQ(b.first, places[a.first]);
      ASSERT_EQ(b.second, a.second);
    } else {
      if (b.first != places[a.first]) {
        std::swap(b.first, b.second);
        std::swap(b.first_after, b.second_after);
      }
      ASSERT_EQ(b.first, places[a.first]) << "collision " << k;
      ASSERT_EQ(b.second, places[a.second]) << "collision " << k;
      ASSERT_EQ(a.second_after, b.second_after) << "collision " << k;
    }
    ASSERT_EQ(a.first_after, b.first_after) << "collision " << k;
  }
  EXPECT_EQ(ordered_stepper->certain_until(), shuffled_stepper->certain_until());
}

TEST(DiscSearch, GeneralEngineFindsTheSame) {
  TracedRandom random(36);
  int collisions = 0;
  for (int trial = 0; trial < 20; ++trial) {
    System system = random_gas(random, 20);
    system.walls.clear();
    std::vector<Particle<double, 2>> balls;
    for (Body& body : system.bodies) {
      for (std::size_t axis : {0u, 1u}) body.velocity[axis] -= (body.position[axis] - 6) / 10;
      balls.push_back({body.mass->get_d(),
                       body.size.get_d(),
                       {body.position[0].get_d(), body.position[1].get_d()},
                       {body.velocity[0].get_d(), body.velocity[1].get_d()}});
    }
    EventSimulator<double, 2> simulator(balls);
    const auto stepper = make_disc_stepper(system);
    while (const auto step = stepper->step()) {
      if (stepper->certain_until() != kForEver) break;
      const auto event = simulator.step();
      ASSERT_TRUE(event);
      ASSERT_EQ(event->first, step->first);
      ASSERT_EQ(event->second, step->second);
      ASSERT_NEAR(event->time, step->time.hi, 1e-6);
      ++collisions;
    }
  }
  EXPECT_GT(collisions, 200);
}

TEST(DiscSearch, TenThousandDiscsKeepTheirEnergy) {
  TracedRandom random(37);
  const System system = random_gas(random, 10'000);
  const auto energy_of = [&](std::size_t body, const std::array<double, 2>& v) {
    return system.bodies[body].mass->get_d() * (v[0] * v[0] + v[1] * v[1]) / 2;
  };
  std::vector<double> energies;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const ExactVector& v = system.bodies[i].velocity;
    energies.push_back(energy_of(i, {v[0].get_d(), v[1].get_d()}));
  }
  const double before = std::accumulate(energies.begin(), energies.end(), 0.0);
  const auto stepper = make_disc_stepper(system);
  double last = 0;
  for (int k = 0; k < 60'000; ++k) {
    const auto step = stepper->step();
    ASSERT_TRUE(step);
    ASSERT_GE(step->time.hi, last);
    last = step->time.hi;
    energies[step->first] = energy_of(step->first, step->first_after.velocity);
    if (step->second >= system.bodies.size()) continue;
    energies[step->second] = energy_of(step->second, step->second_after.velocity);
  }
  EXPECT_NEAR(std::accumulate(energies.begin(), energies.end(), 0.0) / before, 1, 1e-13);
}

}  // namespace
}  // namespace piblocks
