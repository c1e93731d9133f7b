// Round values along an axis.
// In: the ends of the axis and how close marks may be. Out: values and their texts.
#pragma once

#include <string>
#include <vector>

namespace piblocks {

struct Ticks {
  double step = 1;  ///< 1, 2 or 5 times a power of ten
  std::vector<double> values;
};

/// Multiples of the smallest step >= least, from low to high, both included; at most a thousand.
Ticks ticks_of(double low, double high, double least);

/// With as many decimals as the step has.
std::string tick_text(double value, double step);

}  // namespace piblocks
