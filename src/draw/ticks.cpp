#include "draw/ticks.hpp"

#include <algorithm>
#include <cmath>

#include "draw/number_text.hpp"

namespace piblocks {

Ticks ticks_of(double low, double high, double least) {
  constexpr double kMost = 1000;
  Ticks ticks;
  least = std::max(least, (high - low) / kMost);
  if (!(least > 0) || !std::isfinite(least)) return ticks;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1, 2, 5, 10}) {
    ticks.step = factor * power;
    if (ticks.step >= least) break;
  }
  // Counted, so that the last one is not lost to rounding.
  constexpr double kSlack = 1e-9;
  const double first = std::ceil(low / ticks.step - kSlack);
  const double last = std::floor(high / ticks.step + kSlack);
  for (double n = first; n <= last; ++n) ticks.values.push_back(n * ticks.step);
  return ticks;
}

std::string tick_text(double value, double step) {
  const int decimals = static_cast<int>(std::max(0.0, -std::floor(std::log10(step) + 1e-9)));
  return fixed_text(value, decimals);
}

}  // namespace piblocks
