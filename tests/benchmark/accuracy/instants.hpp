// The times at which the methods are asked for blue's position.
// In: nothing. Out: the same ascending times in every run.
#pragma once

#include <algorithm>
#include <vector>

#include "support/property.hpp"

namespace piblocks::benchmark {

inline constexpr double kLastInstant_s = 15;
inline constexpr int kInstants = 600;

inline std::vector<double> random_instants() {
  Random random(1618034);
  std::vector<double> times(kInstants);
  for (double& time : times) time = random.uniform(0, kLastInstant_s);
  std::ranges::sort(times);
  return times;
}

}  // namespace piblocks::benchmark
