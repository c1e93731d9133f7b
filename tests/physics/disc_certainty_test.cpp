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

}  // namespace
}  // namespace piblocks
