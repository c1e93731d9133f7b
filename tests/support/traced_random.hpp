// Random numbers of a test that says how to repeat it where it fails.
// In: a seed of the test's own. Out: numbers, and the trace of failures as long as it lives.
#pragma once

#include <gtest/gtest.h>

#include "support/property.hpp"

namespace piblocks {

class TracedRandom : public Random {
 public:
  explicit TracedRandom(std::uint64_t own_seed, const char* file = __builtin_FILE(),
                        int line = __builtin_LINE())
      : Random(own_seed), trace_(file, line, trace()) {}

 private:
  testing::ScopedTrace trace_;
};

}  // namespace piblocks
