// Two blocks that lose energy: the engine that steps against the closed form.
// In: a TwoBlocks. Out: failures of the running test.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>

#include "physics/logs.hpp"
#include "physics/stepper.hpp"
#include "support/inelastic_checks.hpp"

namespace piblocks {

inline void expect_same_collision(const Log& stepped, const Log& closed, const Integer& index) {
  SCOPED_TRACE("collision " + index.get_str());
  if (!stepped.has(index)) return;  // it ends with a collapse before
  const Collision a = stepped.collision(index);
  const Collision b = closed.collision(index);
  ASSERT_EQ(a.first, b.first);
  ASSERT_EQ(a.second, b.second);
  if (!stepped.is_exact(index)) return;
  EXPECT_NEAR(a.time.hi, b.time.hi, 0x1p-52 * b.time.hi);
  for (const auto& [found, wanted] :
       {std::pair(a.first_after, b.first_after), std::pair(a.second_after, b.second_after)}) {
    EXPECT_NEAR(found.position[0], wanted.position[0], 0x1p-51 * std::fabs(wanted.position[0]));
    EXPECT_NEAR(found.velocity[0], wanted.velocity[0], 0x1p-51 * std::fabs(wanted.velocity[0]));
  }
}

/// Whether flights become shorter so slowly that no engine that steps comes to the end.
inline bool is_nearly_critical(const TwoBlocks& s) {
  const double e = to_double(s.blocks_restitution);
  const double w = to_double(s.wall_restitution);
  const double ratio = to_double(s.blue.mass / s.red.mass);
  const double trace = (1 + e) * (1 + w) / (1 + ratio) - e - w;
  return trace * trace < 4 * e * w * 1.05;
}

inline void expect_stepped_like_closed(const TwoBlocks& blocks) {
  SCOPED_TRACE(describe_inelastic(blocks));
  const System system = system_of(blocks);
  const auto closed = make_pair_log(system);
  const auto stepped = make_stepped_log(system, {}, {}, Engine::unfolded);
  const auto collapse = closed->collapse({});
  constexpr long kMostCompared = 60;
  const Integer compared =
      std::min(Integer(collapse ? closed->last() - 1 : closed->last()), Integer(kMostCompared));
  for (Integer index = 1; index <= compared && !testing::Test::HasFailure(); ++index) {
    expect_same_collision(*stepped, *closed, index);
  }
  if (collapse && (!collapse->time || is_nearly_critical(blocks))) return;
  if (closed->last() > 2000) return;
  const auto found = stepped->collapse({});
  if (!found) {
    // Where numbers have become too long, doubles may miscount or not find the end, and say so.
    const auto until = stepped->certain_until({});
    const bool is_same = !collapse && stepped->last() == closed->last();
    EXPECT_TRUE(is_same || until);
    // Where all is exact there is no excuse.
    const Integer last = stepped->last();
    if (last == 0 || stepped->is_exact(last)) {
      EXPECT_TRUE(is_same) << last;
    }
    const double latest = collapse ? collapse->time->hi * (1 + 0x1p-18) : kForEver;
    EXPECT_LE(until.value_or(kForEver), latest);
    return;
  }
  ASSERT_TRUE(collapse);
  EXPECT_EQ(found->bodies, collapse->bodies);
  const double share = stepped->is_exact(found->listed) ? 1e-13 : 0x1p-18;
  EXPECT_NEAR(found->time->hi, collapse->time->hi, share * collapse->time->hi);
  const Rational after = to_rational(*found->time) + 1;
  EXPECT_TRUE(stepped->state_at(after).is_infinite);
  EXPECT_TRUE(closed->state_at(after).is_infinite);
}

}  // namespace piblocks
