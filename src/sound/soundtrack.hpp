// What a film sounds like: a clack at every collision of each run it shows.
// In: runs, and when and where in the film each is heard. Out: its samples, in order.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <span>
#include <vector>

#include "sound/click.hpp"
#include "sound/run_sound.hpp"

namespace piblocks {

/// Keeps swarms from being louder than -16.5 LUFS. Looks 0.4 s ahead and back, and lowers the gain
/// by as much as the loudest 0.4 s around a sample needs. Where none is too loud every sample stays
/// as it is. Loudness is momentary loudness by EBU R 128, without the filter against what is below
/// 40 Hz.
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

/// Finds peaks between the samples by interpolation, lowers the gain smoothly before one comes, and
/// raises it after it. Without such peaks every sample stays as it is.
class Limiter {
 public:
  /// Pairs that go in before the first one comes out.
  static constexpr int kDelay = 205;

  /// @param ceiling  of the peaks
  Limiter(double ceiling, double rate_hz);

  /// Takes a pair and gives the one of kDelay pairs ago; silence before the first.
  StereoSample next(const StereoSample& pair);

 private:
  static constexpr int kTaps = 24;
  static constexpr int kHalf = kTaps / 2;  ///< on either side
  /// Samples over which the gain falls to what a peak needs.
  static constexpr int kTurn = 192;
  static constexpr std::size_t kRing = 512;  // more than kDelay + kTurn + kTaps
  static constexpr int kPhases = 8;

  double peak_around(std::int64_t number) const;
  double at(std::int64_t number, int channel) const {
    return pairs_[std::size_t(number) % kRing][std::size_t(channel)];
  }
  double& gain(std::int64_t number) { return gains_[std::size_t(number) % kRing]; }
  double& lowest(std::int64_t number) { return lowest_[std::size_t(number) % kRing]; }

  double ceiling_;
  double recovery_;  // share of the reduction that ends with each sample
  std::array<std::array<double, kTaps>, kPhases> kernel_{};
  std::vector<StereoSample> pairs_ = std::vector<StereoSample>(kRing);
  std::vector<double> gains_ = std::vector<double>(kRing, 1.0);   // allowed at each sample
  std::vector<double> lowest_ = std::vector<double>(kRing, 1.0);  // of the kTurn gains from it on
  std::int64_t count_ = kRing;  // pairs taken; the ring is silence
  std::int64_t last_high_ = 0;
  std::int64_t last_below_one_ = 0;
};

/// 48 kHz in stereo. Each collision sounds exactly when the film shows it: never in a freeze, in
/// reverse order if the film goes backwards, unchanged in slow motion. Takes the same memory for a
/// film of any length, and makes the same bits each time. Used by one thread at a time.
class Soundtrack {
 public:
  static constexpr int kRate_hz = 48000;

  /// @param voices      in the order in which they begin; may be empty
  /// @param duration_s  of the film, > 0
  /// @throws UsageError if stretches do not begin at 0 s, or are not in the film's order.
  Soundtrack(std::vector<Voice> voices, const Rational& duration_s);

  /// Writes the next samples, left and right in turn, from -1 to 1.
  /// @return how many pairs; less than there is room for only at the end.
  /// @throws SimulationError as PairLog::state_at().
  std::size_t read(std::span<float> samples);

 private:
  void find_next_voice();
  StereoSample next_limited();

  Rational duration_s_;
  std::int64_t size_;  // pairs: the duration, to the nearest
  std::vector<Voice> voices_;
  std::size_t begun_ = 0;        // of the voices
  std::int64_t next_begin_ = 0;  // pair with which the next one begins
  std::list<RunSound> playing_;
  Leveller leveller_;
  Limiter limiter_;
  std::int64_t mixed_ = 0;  // pairs that went into the leveller
  std::int64_t given_ = 0;  // pairs of the whole
};

}  // namespace piblocks
