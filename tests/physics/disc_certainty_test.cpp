#include "support/disc_certainty.hpp"

#include <gtest/gtest.h>

#include "physics/discs/disc_stepper.hpp"
#include "support/property.hpp"
#include "support/random_discs.hpp"

namespace piblocks {
namespace {

TEST(DiscCertainty, WhatIsCertainOfRandomSystemsIsTrue) {
  Random random(7);
  SCOPED_TRACE(random.trace());
  std::size_t certain = 0;
  const std::int64_t systems = many(60);
  for (std::int64_t k = 0; k < systems; ++k) {
    const CertaintyCheck check = check_certainty(random_discs(random), 200);
    for (const std::string& wrong : check.wrong) ADD_FAILURE() << "system " << k << ": " << wrong;
    certain += check.certain;
  }
  EXPECT_GT(certain, static_cast<std::size_t>(20 * systems));
}

/// Enough discs for cells, and one that has a zone.
TEST(DiscCertainty, WhatIsCertainInCellsIsTrue) {
  Random random(8);
  SCOPED_TRACE(random.trace());
  System system = random_gas(random, 25);
  system.walls = box(46, 16);
  system.bodies.push_back({Rational(100), {20, 7}, {Rational(-1, 9), 0}, 6});
  system.bodies.push_back({std::nullopt, {40, 5}, {0, 0}, 2});
  const CertaintyCheck check = check_certainty(system, 250);
  for (const std::string& wrong : check.wrong) ADD_FAILURE() << wrong;
  EXPECT_GT(check.certain, 60u);
}

}  // namespace
}  // namespace piblocks
