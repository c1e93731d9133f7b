// What `piblocks render --profile` says of its stages.
// In: its standard error. Out: processor time of each stage.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace piblocks::benchmark {

struct StageTime {
  std::string stage;
  double cpu_seconds = 0;
};

/// The lines of the form "  paint        0.031 s   0.037 ms/frame   2.1 %", in their order; others
/// are not looked at.
std::vector<StageTime> parse_profile(std::string_view text);

}  // namespace piblocks::benchmark
