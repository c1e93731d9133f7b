// Systems on which the article's loop miscounts, divides by zero or never ends: every collision,
// and states at hard times. Totals of others are in tests/physics/collision_log_test.cpp.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <string>
#include <vector>

#include "stress/log_checks.hpp"
#include "support/oracle.hpp"

namespace piblocks::stress {
namespace {

/// Unit blocks beside a wall at 0.
struct HardCase {
  std::string name;
  const char* blue_mass;
  const char* red_mass;
  const char* blue_gap;
  const char* blocks_gap;
  const char* blue_velocity;
  const char* red_velocity;
  long total;

  TwoBlocks system() const {
    TwoBlocks s;
    s.blue.mass = parse_rational(blue_mass);
    s.red.mass = parse_rational(red_mass);
    s.blue.position = parse_rational(blue_gap) + Rational(1, 2);
    s.red.position = s.blue.position + 1 + parse_rational(blocks_gap);
    s.blue.velocity = parse_rational(blue_velocity);
    s.red.velocity = parse_rational(red_velocity);
    return s;
  }
  friend void PrintTo(const HardCase& hard, std::ostream* out) { *out << hard.name; }
};

class HardCases : public testing::TestWithParam<HardCase> {};

TEST_P(HardCases, HaveTheirTotal) {
  const TwoBlocks system = GetParam().system();
  EXPECT_EQ(count_collisions(system), GetParam().total);
  EXPECT_EQ(make_pair_log(system)->last(), GetParam().total);
  EXPECT_EQ(oracle::high_precision_total(system), GetParam().total);
}

TEST_P(HardCases, HaveAConsistentLog) {
  const TwoBlocks system = GetParam().system();
  const auto log = make_pair_log(system);
  const Bounds bounds(system);
  for (Integer k = 1; k <= log->last(); ++k) expect_consistent(system, *log, k, bounds);
}

TEST_P(HardCases, AreWhereTheOracleSaysAtHardTimes) {
  const TwoBlocks system = GetParam().system();
  const auto log = make_pair_log(system);
  const Bounds bounds(system);
  const bool meets = log->last() > 0;
  const Rational turn =
      meets ? to_rational(log->blocks_collision((log->last() + 1) / 2).time) : Rational(1);
  const Rational last =
      meets ? to_rational(log->blocks_collision(log->last()).time) + 1 : Rational(1);
  const Rational hair = parse_rational("1e-16");
  const std::vector<Rational> times = {
      0,           -last,       -1000 * last,      1000 * last,  turn,
      turn - hair, turn + hair, turn * (1 - hair), -last * hair, power(10, 5) * last};
  for (const Rational& time : times) expect_oracles_state(system, *log, time, bounds);
}

TEST_P(HardCases, CountEveryCollisionAtItsExactTime) {
  const TwoBlocks system = GetParam().system();
  const auto log = make_pair_log(system);
  const std::vector<oracle::ExactEvent> run = oracle::exact_run(system, 1000);
  ASSERT_EQ(log->last(), run.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    const oracle::ExactState exact = oracle::exact_state(system, run, run[i].time);
    const PairState state = log->blocks_at(run[i].time);
    ASSERT_EQ(state.count, exact.count) << "at the time of collision " << i + 1;
    EXPECT_EQ(log->blocks_collision(Integer(i + 1)).kind, run[i].kind);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, HardCases,
    testing::Values(HardCase{"very light red", "1", "1e-32", "3/2", "2", "0", "-1", 2},
                    HardCase{"ratio 1/3", "1", "1/3", "3/2", "2", "0", "-1", 2},
                    HardCase{"ratio 1", "1", "1", "3/2", "2", "0", "-1", 3},
                    HardCase{"ratio 3", "1", "3", "3/2", "2", "0", "-1", 5},
                    HardCase{"ratio 1, both moving", "1", "1", "1", "1", "-1", "-2", 4},
                    HardCase{"ratio 3, both moving", "1", "3", "1", "1", "-1", "-2", 6},
                    HardCase{"ratio 100, both moving", "1", "100", "1", "1", "-1", "-2", 32},
                    HardCase{"out of the corner", "1", "100", "1", "1", "1", "2", 0},
                    HardCase{"out of the corner, equal masses", "1", "1", "1", "1", "1", "2", 0},
                    HardCase{"out of the corner, touching", "1", "100", "1", "0", "1", "1", 0},
                    HardCase{"in the corner, blue outward", "1", "100", "0", "0", "1", "0", 15},
                    HardCase{"in the corner, both outward", "1", "100", "0", "0", "1", "1", 0},
                    HardCase{"in the corner, red outward", "1", "100", "0", "0", "0", "1", 0},
                    HardCase{"in the corner, red inward", "1", "100", "0", "0", "0", "-1", 31},
                    HardCase{"blue rests on the wall", "1", "10000", "0", "3/2", "0", "-1", 314},
                    HardCase{"red leaves a blue on the wall", "1", "10000", "0", "3/2", "0", "1",
                             0},
                    HardCase{"touching and together", "1", "100", "3/2", "0", "-1", "-1", 31},
                    HardCase{"in contact, approaching", "1", "100", "3/2", "0", "0", "-1", 31},
                    HardCase{"in contact, separating", "1", "100", "3/2", "0", "-1", "0", 16},
                    HardCase{"at the wall, inward", "1", "100", "0", "3/2", "-1", "-1", 31},
                    HardCase{"at the wall, outward", "1", "100", "0", "3/2", "1", "-1", 30},
                    HardCase{"equal velocities, inward", "1", "100", "3/2", "2", "-1", "-1", 31},
                    HardCase{"equal velocities, outward", "1", "100", "3/2", "2", "1", "1", 0},
                    HardCase{"red recedes", "1", "100", "3/2", "2", "0", "1", 0},
                    HardCase{"all at rest", "1", "100", "3/2", "2", "0", "0", 0},
                    HardCase{"blue hardly outward", "1", "100", "3/2", "2", "1e-300", "0", 15},
                    HardCase{"blue hardly inward", "1", "100", "3/2", "2", "-1e-300", "0", 16},
                    HardCase{"slow", "1", "10000", "3/2", "2", "0", "-1e-300", 314},
                    HardCase{"fast", "1", "10000", "3/2", "2", "0", "-1e155", 314},
                    HardCase{"light", "1e-200", "1e-196", "3/2", "2", "0", "-1", 314},
                    HardCase{"heavy", "1e154", "1e158", "3/2", "2", "0", "-1", 314},
                    HardCase{"far", "1", "10000", "3/2", "1e15", "0", "-1", 314},
                    HardCase{"very far", "1", "10000", "3/2", "1e100", "0", "-1", 314}));

TEST(HardNumbers, DenormalMassesAreTheDoublesTheyAre) {
  TwoBlocks system;
  system.blue.mass = Rational(5e-324);
  system.red.mass = Rational(5e-320);
  EXPECT_EQ(system.red.mass / system.blue.mass, 10120) << "neither is the decimal that was written";
  EXPECT_EQ(count_collisions(system), 316);
  EXPECT_EQ(make_pair_log(system)->last(), 316);
}

TEST(HardNumbers, TimesBeyondADoubleAreAnError) {
  TwoBlocks system;
  system.red.velocity = -Rational(5e-324);  // meets blue after 4e323 units of time
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->last(), 314);
  EXPECT_THROW(log->blocks_collision(1), SimulationError);
  EXPECT_THROW(log->blocks_at(power(10, 400)), SimulationError);
}

}  // namespace
}  // namespace piblocks::stress
