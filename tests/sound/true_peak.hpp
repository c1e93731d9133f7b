// How high a sampled signal goes between its samples.
// In: samples of one channel. Out: the highest of eight times as many.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace piblocks::testing_support {

/// @param tap_at  the weight of a sample so far away, up to `reach`
template <typename Tap>
double interpolated_peak(const std::vector<double>& samples, int reach, const Tap& tap_at) {
  constexpr int kPhases = 8;
  double peak = 0;
  // Of parts as long as the taps: two parts hold all samples that meet the taps.
  std::vector<double> loudest(samples.size() / std::size_t(2 * reach) + 2);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double& part = loudest[i / std::size_t(2 * reach)];
    part = std::max(part, std::fabs(samples[i]));
  }
  for (int phase = 0; phase < kPhases; ++phase) {
    std::vector<double> taps;
    double gain = 0;
    for (int tap = 1 - reach; tap <= reach; ++tap) {
      taps.push_back(tap_at(tap - double(phase) / kPhases));
      gain += std::fabs(taps.back());
    }
    for (std::size_t first = 0; first + taps.size() <= samples.size(); ++first) {
      // Most of a soundtrack is far below its peak.
      const std::size_t part = first / taps.size();
      if (std::max(loudest[part], loudest[part + 1]) * gain <= peak) continue;
      double value = 0;
      for (std::size_t tap = 0; tap < taps.size(); ++tap) value += samples[first + tap] * taps[tap];
      peak = std::max(peak, std::fabs(value));
    }
  }
  return peak;
}

inline double true_peak(const std::vector<double>& samples) {
  constexpr int kReach = 32;
  return interpolated_peak(samples, kReach, [](double x) {
    const double angle = std::numbers::pi * x;
    const double window = std::pow(std::cos(angle / 2 / (kReach + 1)), 2);
    return window * (x == 0 ? 1 : std::sin(angle) / angle);
  });
}

}  // namespace piblocks::testing_support
