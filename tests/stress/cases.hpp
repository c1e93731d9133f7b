// Many independent random cases, each of which can be repeated alone.
// In: how many, and a check of one case. Out: for the first that fails, the command to repeat it.
#pragma once

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "support/property.hpp"

namespace piblocks::stress {

/// Whether one case is run again, alone.
inline bool is_repetition() { return std::getenv("PIBLOCKS_SEED") != nullptr; }

/// The command that runs one case of the running test again.
inline std::string repeat_command(std::uint64_t seed) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  return "repeat with PIBLOCKS_SEED=" + std::to_string(seed) + " " + program_invocation_name +
         " --gtest_filter=" + test->test_suite_name() + "." + test->name();
}

/// Calls check(random) with a seed of its own for each of many(ordinary) cases, up to the first
/// that fails. If PIBLOCKS_SEED is set there is one case, with that seed.
template <typename Check>
void for_each_case(std::int64_t ordinary, std::uint64_t first_seed, const Check& check) {
  const std::int64_t cases = is_repetition() ? 1 : many(ordinary);
  for (std::int64_t i = 0; i < cases; ++i) {
    Random random(first_seed + static_cast<std::uint64_t>(i));
    SCOPED_TRACE(repeat_command(random.seed()));
    // An exception that nobody expects would leave the trace, and with it the seed, behind.
    EXPECT_NO_THROW(check(random));
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace piblocks::stress
