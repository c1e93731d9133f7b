#include "sound/leveller.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace piblocks {
namespace {

/// Weighted energy of 0.4 s at -16.5 LUFS: 10^((-16.5 + 0.691)/10) in a pair.
constexpr double kMostEnergy = 0.02625 * 19200;

/// A hop with less energy counts as silence and resets the filters: tiny numbers would slow
/// processors down.
constexpr double kSilence = 1e-20;

}  // namespace

/// ITU-R BS.1770-4, table 1.
double Leveller::Weighting::next(double x) {
  const double y = 1.53512485958697 * x - 2.69169618940638 * x1 + 1.19839281085285 * x2 +
                   1.69065929318241 * y1 - 0.73248077421585 * y2;
  x2 = x1;
  x1 = x;
  y2 = y1;
  y1 = y;
  return y;
}

/// Takes the hop that just ended in, and lets the next one out.
void Leveller::end_hop() {
  if (energy_ < kSilence) weighted_ = {};
  hops_[oldest_] = energy_;
  windows_[oldest_] = std::accumulate(hops_.begin(), hops_.end(), 0.0);
  oldest_ = (oldest_ + 1) % kWindow;
  energy_ = 0;
  // All these windows contain the hop of which both neighbours are known now.
  const double most = std::ranges::max(windows_);
  const double hop_gain = most > kMostEnergy ? std::sqrt(kMostEnergy / most) : 1;
  from_ = to_;
  to_ = std::min(hop_gain_, hop_gain);
  hop_gain_ = hop_gain;
}

StereoSample Leveller::next(const StereoSample& pair) {
  const double part = double(place_ % kHop) / kHop;
  const double gain = from_ + part * (to_ - from_);
  const StereoSample out{gain * pairs_[place_][0], gain * pairs_[place_][1]};
  pairs_[place_] = pair;
  for (std::size_t channel = 0; channel < 2; ++channel) {
    const double weighted = weighted_[channel].next(pair[channel]);
    energy_ += weighted * weighted;
  }
  if (++place_ % kHop == 0) end_hop();
  if (place_ == pairs_.size()) place_ = 0;
  return out;
}

}  // namespace piblocks
