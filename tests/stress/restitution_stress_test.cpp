// Ten thousand systems that lose energy, against steps in rational numbers.
#include <gtest/gtest.h>

#include "support/damped_checks.hpp"

namespace piblocks {
namespace {

TEST(RestitutionStress, RandomSystemsMoveAsStepByStep) {
  Random random(11);
  SCOPED_TRACE(random.trace());
  for (std::int64_t i = 0; i < many(500) && !testing::Test::HasFailure(); ++i) {
    expect_like_steps(random_damped_system(random), random, i % 20 == 0 ? 300 : 60);
  }
}

}  // namespace
}  // namespace piblocks
