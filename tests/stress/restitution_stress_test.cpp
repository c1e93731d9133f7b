// Systems that lose energy: ten thousand against steps in rational numbers, and others of any size.
#include <gtest/gtest.h>

#include <cmath>

#include "stress/random_system.hpp"
#include "support/contains.hpp"
#include "support/inelastic_checks.hpp"
#include "support/stepped_checks.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

TEST(RestitutionStress, RandomSystemsMoveAsStepByStep) {
  TracedRandom random(11);
  for (std::int64_t i = 0; i < many(250) && !testing::Test::HasFailure(); ++i) {
    expect_like_steps(random_inelastic_system(random), random, i % 20 == 0 ? 300 : 60);
  }
}

TEST(RestitutionStress, StepsAgreeWithTheClosedForm) {
  TracedRandom random(12);
  for (std::int64_t i = 0; i < many(500) && !testing::Test::HasFailure(); ++i) {
    expect_stepped_like_closed(random_inelastic_system(random));
  }
}

/// From nothing at all to all.
Rational wild_restitution(Random& random) {
  switch (random.integer(0, 4)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return Rational(std::pow(10, -random.uniform(0, 300)));
    case 3:
      return 1 - Rational(std::pow(10, -random.uniform(0, 60)));
    default:
      return random.rational(0, 1, 100);
  }
}

/// The last collision, the first and those between, at the times that they are said to have.
void expect_own_times(const PairLog& log) {
  if (log.last() == 0) return;
  for (int quarter = 0; quarter <= 4; ++quarter) {
    const Integer index = 1 + (log.last() - 1) * quarter / 4;
    try {
      const Rational time = log.time_after(index);
      EXPECT_EQ(log.blocks_at(time).count, index);
      const Gaps gaps = log.gaps_at(time);
      EXPECT_LE(0, gaps.y1);
      EXPECT_LE(gaps.y1, gaps.y2);
      EXPECT_EQ(log.blocks_collision(index).index, index);
    } catch (const UsageError& error) {  // all at the same time
      EXPECT_TRUE(testing_support::contains(error.what(), "at the same time"));
    } catch (const SimulationError& error) {
      EXPECT_TRUE(testing_support::contains(error.what(), "beyond the range"));
    }
  }
}

TEST(RestitutionStress, NumbersOfAnySize) {
  TracedRandom random(5);
  for (std::int64_t i = 0; i < many(200) && !testing::Test::HasFailure(); ++i) {
    TwoBlocks system =
        i % 2 == 0 ? stress::random_system(random) : stress::random_system_of_any_size(random);
    system.blocks_restitution = wild_restitution(random);
    system.wall_restitution = wild_restitution(random);
    if (is_elastic(system) || !problems_of(system_of(system)).empty()) continue;
    SCOPED_TRACE(describe_inelastic(system));
    const auto log = make_pair_log(system);
    expect_own_times(*log);
    EXPECT_EQ(is_endless(*log), collapse_of(system).has_value());
    if (is_endless(*log)) continue;
    EXPECT_EQ(count_collisions(system), log->last());
  }
}

}  // namespace
}  // namespace piblocks
