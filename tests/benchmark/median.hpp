// The middle one of some measurements.
// In: numbers in any order. Out: the median, the upper one of two; nothing if there are none.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

namespace piblocks::benchmark {

inline std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace piblocks::benchmark
