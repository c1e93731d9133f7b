// Keeps the sound below full scale, also between the samples.
// In: pairs of samples of any height. Out: the same, quieter around those that are too high.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace piblocks {

/// Finds peaks between the samples by interpolation, lowers the gain smoothly before one comes, and
/// raises it after it. Without such peaks every sample stays as it is.
class Limiter {
 public:
  using Pair = std::array<double, 2>;

  /// Pairs that go in before the first one comes out.
  static constexpr int kDelay = 205;

  /// @param ceiling  of the peaks
  Limiter(double ceiling, double rate_hz);

  /// Takes a pair and gives the one of kDelay pairs ago; silence before the first.
  Pair next(const Pair& pair);

 private:
  static constexpr int kTaps = 24;
  static constexpr int kHalf = kTaps / 2;  ///< on either side
  /// Samples over which the gain falls to what a peak needs.
  static constexpr int kTurn = 192;
  static constexpr std::size_t kRing = 512;  // more than kDelay + kTurn + kTaps
  static constexpr int kPhases = 8;

  double peak_around(std::int64_t number) const;
  double at(std::int64_t number, int channel) const {
    return pairs_[static_cast<std::size_t>(number) % kRing][static_cast<std::size_t>(channel)];
  }
  double& gain(std::int64_t number) { return gains_[static_cast<std::size_t>(number) % kRing]; }
  double& lowest(std::int64_t number) { return lowest_[static_cast<std::size_t>(number) % kRing]; }

  double ceiling_;
  double recovery_;  // share of the reduction that ends with each sample
  std::array<std::array<double, kTaps>, kPhases> kernel_{};
  std::vector<Pair> pairs_ = std::vector<Pair>(kRing);
  std::vector<double> gains_ = std::vector<double>(kRing, 1.0);   // allowed at each sample
  std::vector<double> lowest_ = std::vector<double>(kRing, 1.0);  // of the kTurn gains from it on
  std::int64_t count_ = kRing;  // pairs taken; the ring is silence
  std::int64_t last_high_ = 0;
  std::int64_t last_below_one_ = 0;
};

}  // namespace piblocks
