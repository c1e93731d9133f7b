#include "sound/compressor.hpp"

#include <algorithm>
#include <cmath>

namespace piblocks {
namespace {

/// Sums of impulses go on as (m_red / m_blue), which may be more than a double holds.
constexpr double kMost = 1e300;

constexpr double kHighest = 8;

/// 1 at no distance, falling smoothly to 0 at kTogether_samples.
double nearness(double distance_samples) {
  const double x = distance_samples / kTogether_samples;
  const double bell = std::max(0.0, 1 - x * x);
  return bell * bell;
}

double bounded(double impulse) { return std::min(impulse, kMost); }

}  // namespace

double compressed(double impulse) {
  const double knee = std::asinh(bounded(impulse));
  return knee / (1 + knee / kHighest);
}

double height(std::span<const Clack> clacks, std::size_t index) {
  const double sample = clacks[index].sample;
  const double own = bounded(clacks[index].impulse);
  if (own == 0) return 0;
  double together = own;
  for (std::size_t i = index; i-- > 0 && sample - clacks[i].sample < kTogether_samples;) {
    together += nearness(sample - clacks[i].sample) * bounded(clacks[i].impulse);
  }
  for (std::size_t i = index + 1;
       i < clacks.size() && clacks[i].sample - sample < kTogether_samples; ++i) {
    together += nearness(clacks[i].sample - sample) * bounded(clacks[i].impulse);
  }
  return compressed(together) * (own / together);
}

}  // namespace piblocks
