// Random systems of discs: what the engine calls certain, against 400 bits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "support/disc_certainty.hpp"
#include "support/property.hpp"
#include "support/random_discs.hpp"

namespace piblocks::stress {
namespace {

void check_systems(const std::function<BodySystem(Random&)>& draw, double expected) {
  Random random(71);
  SCOPED_TRACE(random.trace());
  const std::int64_t systems = many(2000);
  std::size_t certain = 0;
  std::int64_t complete = 0;
  double widest = 0;
  for (std::int64_t k = 0; k < systems; ++k) {
    const BodySystem system = draw(random);
    const CertaintyCheck check = check_certainty(system, 500);
    for (const std::string& wrong : check.wrong) ADD_FAILURE() << "system " << k << ": " << wrong;
    certain += check.certain;
    if (check.is_complete) ++complete;
    widest = std::max(widest, check.widest);
  }
  fmt::print(
      "{} systems, {} of them certain to the end: {} certain collisions, {:.1f} on average; "
      "errors up to {:.2f} of their bounds\n",
      systems, complete, certain, static_cast<double>(certain) / static_cast<double>(systems),
      widest);
  EXPECT_GT(static_cast<double>(certain), expected * static_cast<double>(systems));
}

TEST(DiscCertaintyStress, OfRandomDiscs) { check_systems(random_discs, 30); }

TEST(DiscCertaintyStress, OfDiscsThatMeetByCoincidence) { check_systems(random_coincidences, 3); }

}  // namespace
}  // namespace piblocks::stress
