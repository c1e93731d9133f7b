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

/// The number of the one case to run again, if there is one.
inline const char* repeated_case() { return std::getenv("PIBLOCKS_CASE"); }

/// The command that runs one case of the running test again.
inline std::string repeat_command(std::int64_t number) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  return Random::trace() + " PIBLOCKS_CASE=" + std::to_string(number) + " " +
         program_invocation_name + " --gtest_filter=" + test->test_suite_name() + "." +
         test->name();
}

/// Calls check(random) with a seed of its own for each of many(ordinary) cases, up to the first
/// that fails; with PIBLOCKS_CASE for that one alone.
template <typename Check>
void for_each_case(std::int64_t ordinary, std::uint64_t first_seed, const Check& check) {
  const char* const one = repeated_case();
  const std::int64_t first = one == nullptr ? 0 : std::atoll(one);
  const std::int64_t end = one == nullptr ? many(ordinary) : first + 1;
  for (std::int64_t i = first; i < end; ++i) {
    Random random(first_seed + static_cast<std::uint64_t>(i));
    SCOPED_TRACE(repeat_command(i));
    // An exception that nobody expects would leave the trace, and with it the seed, behind.
    EXPECT_NO_THROW(check(random));
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace piblocks::stress
