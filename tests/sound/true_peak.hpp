// How high a sampled signal goes between its samples.
// In: samples of one channel. Out: the highest of eight times as many.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace piblocks::testing_support {

inline double true_peak(const std::vector<double>& samples) {
  constexpr int kReach = 32;
  constexpr int kPhases = 8;
  double peak = 0;
  for (int phase = 0; phase < kPhases; ++phase) {
    std::vector<double> taps;
    for (int tap = -kReach + 1; tap <= kReach; ++tap) {
      const double x = tap - double(phase) / kPhases;
      const double angle = std::numbers::pi * x;
      const double window = std::pow(std::cos(angle / 2 / (kReach + 1)), 2);
      taps.push_back(window * (x == 0 ? 1 : std::sin(angle) / angle));
    }
    for (std::size_t i = kReach; i + kReach < samples.size(); ++i) {
      double value = 0;
      for (std::size_t tap = 0; tap < taps.size(); ++tap) {
        value += taps[tap] * samples[i + tap + 1 - kReach];
      }
      peak = std::max(peak, std::fabs(value));
    }
  }
  return peak;
}

}  // namespace piblocks::testing_support
