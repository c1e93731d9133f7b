// Keeps swarms from being too loud.
// In: pairs of samples. Out: the same, lower where 0.4 s of them would be louder than -16.5 LUFS.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sound/click.hpp"

namespace piblocks {

/// Looks 0.4 s ahead and back, and lowers the gain by as much as the loudest 0.4 s around a sample
/// needs. Where none is too loud every sample stays as it is. Loudness is momentary loudness by
/// EBU R 128, without the filter against what is below 40 Hz.
class Leveller {
 public:
  /// Pairs that go in before the first one comes out.
  static constexpr int kDelay = 20160;

  /// Takes a pair at 48 kHz and gives the one of kDelay pairs ago; silence before the first.
  StereoSample next(const StereoSample& pair);

 private:
  static constexpr int kHop = 480;  ///< pairs, 10 ms
  /// Hops that have all of 0.4 s, wherever it begins.
  static constexpr int kWindow = 41;
  static_assert(kDelay == (kWindow + 1) * kHop);

  /// One channel as the ear weighs it: treble is 4 dB higher.
  struct Weighting {
    double x1 = 0;
    double x2 = 0;
    double y1 = 0;
    double y2 = 0;

    double next(double x);
  };

  void end_hop();

  std::array<Weighting, 2> weighted_;
  double energy_ = 0;                      // of this hop, weighted
  std::array<double, kWindow> hops_{};     // energies of the last hops
  std::array<double, kWindow> windows_{};  // and of the windows that end with them
  std::size_t oldest_ = 0;                 // in both
  double hop_gain_ = 1;
  double from_ = 1;  // gains at the beginning and the end of the hop that comes out
  double to_ = 1;
  std::size_t place_ = 0;  // in pairs_
  std::vector<StereoSample> pairs_ = std::vector<StereoSample>(kDelay);
};

}  // namespace piblocks
