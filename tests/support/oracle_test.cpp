#include "support/oracle.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include "support/traced_random.hpp"

namespace piblocks::oracle {
namespace {

constexpr std::int64_t kMaxEvents = 100'000;

TwoBlocks blocks_with(const Rational& ratio) {
  TwoBlocks system;
  system.red.mass = ratio;
  return system;
}

/// A system with these gaps and velocities, blue's mass 1 and widths 1.
TwoBlocks gap_system(const Rational& ratio, const Rational& wall_gap, const Rational& blocks_gap,
                     const Rational& u_blue, const Rational& u_red) {
  const Rational half(1, 2);
  return {0, {1, wall_gap + half, u_blue, 1}, {ratio, wall_gap + 1 + blocks_gap + half, u_red, 1}};
}

TwoBlocks random_system(Random& random) {
  TwoBlocks system;
  system.wall_face = random.rational(-5, 5, 7);
  system.blue.mass = random.rational(1, 40, 3);
  system.red.mass = random.rational(1, 4000, 5) / random.integer(1, 300);
  system.blue.width = random.rational(1, 3, 4);
  system.red.width = random.rational(1, 3, 9);
  system.blue.velocity = random.rational(-4, 4, 11);
  system.red.velocity = random.rational(-4, 4, 13);
  // One in a few starts in contact with the wall, and one in a few with the other block.
  const Rational wall_gap = random.integer(0, 4) == 0 ? Rational(0) : random.rational(0, 6, 17);
  const Rational blocks_gap = random.integer(0, 4) == 0 ? Rational(0) : random.rational(0, 6, 19);
  system.blue.position = system.wall_face + system.blue.width / 2 + wall_gap;
  system.red.position =
      system.blue.position + (system.blue.width + system.red.width) / 2 + blocks_gap;
  return system;
}

void expect_near(const ExactMotion& actual, const ExactMotion& expected, const char* who) {
  const Rational tolerance = 1 / power(2, 100);
  EXPECT_LT(abs(actual.position - expected.position), tolerance) << who;
  EXPECT_LT(abs(actual.velocity - expected.velocity), tolerance) << who;
}

/// Both routes tell the same at time t.
void expect_agreement(const TwoBlocks& system, const std::vector<ExactEvent>& run,
                      const Rational& t) {
  SCOPED_TRACE("t = " + std::to_string(t.get_d()));
  const ExactState exact = exact_state(system, run, t, kMaxEvents);
  const ExactState unfolded = high_precision_state(system, t);
  EXPECT_EQ(unfolded.count, exact.count);
  expect_near(unfolded.blue, exact.blue, "blue");
  expect_near(unfolded.red, exact.red, "red");
}

TEST(Oracle, ExactRunOfOneDigitIsTheTextbooks) {
  const std::vector<ExactEvent> run = exact_run(blocks_with(1), 10);
  ASSERT_EQ(run.size(), 3u);
  EXPECT_EQ(run[0].kind, CollisionKind::blocks);
  EXPECT_EQ(run[0].time, 2);
  EXPECT_EQ(run[0].blue.velocity, -1);
  EXPECT_EQ(run[0].red.velocity, 0);
  EXPECT_EQ(run[0].red.position, 3);
  EXPECT_EQ(run[1].kind, CollisionKind::wall);
  EXPECT_EQ(run[1].time, Rational(7, 2));
  EXPECT_EQ(run[1].blue.position, Rational(1, 2));
  EXPECT_EQ(run[2].kind, CollisionKind::blocks);
  EXPECT_EQ(run[2].time, 5);
  EXPECT_EQ(run[2].red.velocity, 1);
}

TEST(Oracle, ExactRunConservesEnergyExactly) {
  const TwoBlocks system = blocks_with(100);
  for (const ExactEvent& event : exact_run(system, 100)) {
    EXPECT_EQ(
        event.blue.velocity * event.blue.velocity + 100 * event.red.velocity * event.red.velocity,
        100);
  }
}

TEST(Oracle, ExactRunRefusesMoreEventsThanAllowed) {
  EXPECT_EQ(exact_run(blocks_with(100), 31).size(), 31u);
  EXPECT_THROW(exact_run(blocks_with(100), 30), SimulationError);
}

TEST(Oracle, CountsDigitsOfPi) {
  EXPECT_EQ(high_precision_total(blocks_with(1)), 3);
  EXPECT_EQ(high_precision_total(blocks_with(power(100, 8))), 314159265);
  EXPECT_EQ(high_precision_total(blocks_with(power(100, 16))), Integer("31415926535897932"));
  EXPECT_EQ(high_precision_total(blocks_with(power(100, 50))),
            Integer("314159265358979323846264338327950288419716939937510"));
}

// Rays reached only at infinity must not count: pi/theta is an integer for these ratios.
TEST(Oracle, CountsStrictlyWherePiOverThetaIsAnInteger) {
  EXPECT_EQ(high_precision_total(blocks_with(Rational(1, 3))), 2);
  EXPECT_EQ(high_precision_total(blocks_with(3)), 5);
}

class ArticleSystem : public testing::TestWithParam<int> {};

TEST_P(ArticleSystem, RoutesAgree) {
  const TwoBlocks system = blocks_with(power(100, static_cast<unsigned long>(GetParam()) - 1));
  const std::vector<ExactEvent> run = exact_run(system, kMaxEvents);
  EXPECT_EQ(high_precision_total(system), static_cast<long>(run.size()));
  const std::size_t stride = run.size() / 150 + 1;
  for (std::size_t k = 0; k + 1 < run.size(); k += stride) {
    SCOPED_TRACE("collision " + std::to_string(k + 1));
    expect_agreement(system, run, run[k].time);
    expect_agreement(system, run, (run[k].time + run[k + 1].time) / 2);
  }
  for (const Rational& t : {Rational(-3), Rational(0), Rational(1, 3), Rational(500)}) {
    expect_agreement(system, run, t);
  }
}

INSTANTIATE_TEST_SUITE_P(Digits, ArticleSystem, testing::Values(1, 2, 3, 4));

TEST(Oracle, RoutesAgreeForRandomSystems) {
  TracedRandom random(2024);
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const TwoBlocks system = random_system(random);
    const std::vector<ExactEvent> run = exact_run(system, kMaxEvents);
    EXPECT_EQ(high_precision_total(system), static_cast<long>(run.size()));
    for (std::size_t k = 0; k + 1 < run.size(); ++k) {
      expect_agreement(system, run, (run[k].time + run[k + 1].time) / 2);
    }
    for (int sample = 0; sample < 5; ++sample) {
      expect_agreement(system, run, random.rational(-20, 20, 1'000'003));
    }
    if (HasFailure()) return;
  }
}

// Simultaneous collisions in the wall's corner, and starts in contact.
TEST(Oracle, RoutesAgreeInTheCorner) {
  struct Case {
    TwoBlocks system;
    int total;
  };
  const std::vector<Case> cases = {
      {gap_system(100, 0, 3, 0, -1), 31},   // blue rests at the wall
      {gap_system(1, 1, 1, -1, -2), 4},     // both arrive in the corner at once
      {gap_system(3, 1, 1, -1, -2), 6},     //
      {gap_system(100, 1, 1, -1, -2), 32},  //
      {gap_system(100, 2, 0, -1, -1), 31},  // in contact, moving to the wall together
      {gap_system(100, 0, 0, 0, -1), 31},   // start in the corner
      {gap_system(100, 0, 0, -1, 1), 1},    //
      {gap_system(100, 0, 0, 1, 2), 0},     //
      {gap_system(100, 2, 0, 0, -1), 31},   // in contact, approaching
      {gap_system(100, 2, 0, 0, 1), 0},     // separating
      {gap_system(100, 2, 0, -1, 1), 1},    //
      {gap_system(100, 0, 2, -1, -1), 31},  // blue at the wall, moving in
      {gap_system(100, 0, 2, 1, -1), 30},   // moving out
      {gap_system(100, 2, 2, 1, 1), 0},     //
      {gap_system(100, 2, 2, 0, 0), 0},     // at rest
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto& [system, total] = cases[i];
    const std::vector<ExactEvent> run = exact_run(system, kMaxEvents);
    EXPECT_EQ(run.size(), static_cast<std::size_t>(total));
    EXPECT_EQ(high_precision_total(system), total);
    for (const Rational& t : {Rational(0), Rational(1, 7), Rational(1), Rational(2), Rational(3),
                              Rational(15, 2), Rational(40)}) {
      expect_agreement(system, run, t);
    }
    expect_agreement(system, run, Rational(-13, 3));
  }
}

}  // namespace
}  // namespace piblocks::oracle
