// What one run of a film sounds like before anything is limited.
// In: a voice. Out: pairs of samples of any height, from its first one on.
#pragma once

#include <piblocks/scene.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "sound/clack_stream.hpp"
#include "sound/click.hpp"

namespace piblocks {

/// An even change of weight between two instants of the film, in seconds.
struct Ramp {
  Rational begin_s;
  Rational end_s;  ///< > begin_s
};

/// A run as a film has it.
struct Voice {
  const Scene& scene;              ///< must outlive the sound
  const Log& log;                  ///< must outlive the sound
  std::vector<Stretch> stretches;  ///< as Schedule has them, from begin_s on
  Rational begin_s = 0;            ///< when it begins in the film, >= 0
  Rational end_s = 0;              ///< > begin_s; it is silent from then on
  std::optional<Ramp> rise = {};   ///< its weight goes from 0 to 1
  std::optional<Ramp> fall = {};   ///< and from 1 to 0; without it, it ends with a cut
  /// Where its picture is in the frame, from 0, the left edge, to 1, the right one.
  double left = 0;
  double right = 1;
};

/// Takes the same memory for a run of any length. Used by one thread at a time.
class RunSound {
 public:
  /// @param film_s  the film's duration; a voice that lasts until then rings on beyond it
  RunSound(const Voice& voice, const Rational& film_s, int rate_hz);

  /// The sample of the film in which next() begins.
  static std::int64_t first_sample(const Voice& voice, int rate_hz);
  bool is_over() const noexcept { return double(sample_) >= end_; }
  StereoSample next();

 private:
  static constexpr std::int64_t kBlock = 1024;  // pairs
  static constexpr std::int64_t kReach = ClickKernel::kReach;

  /// A ramp in samples; none if both are equal.
  struct SampleRamp {
    double begin = 0;
    double end = 0;
  };

  static SampleRamp in_samples(const std::optional<Ramp>& ramp, int rate_hz);
  StereoSample channels(const Clack& clack) const;
  void add_clicks();
  void make_block();
  double weight() const;

  double view_low_;
  double view_width_;
  double left_;
  double width_;
  std::int64_t sample_;  // of the film, the next one
  double end_ = std::numeric_limits<double>::infinity();
  SampleRamp rise_;
  SampleRamp fall_;
  ClackStream stream_;
  ClickKernel kernel_;
  Timbre wall_;
  Timbre blocks_;

  std::vector<Clack> clacks_;  // those that still matter, by samples from the first one on
  std::size_t clicked_ = 0;    // of them, how many are in the clicks
  // Pairs of samples from block_begin_ - kReach on, as far as clicks reach.
  std::vector<double> wall_clicks_ = std::vector<double>(2 * (kBlock + 3 * kReach));
  std::vector<double> block_clicks_ = std::vector<double>(2 * (kBlock + 3 * kReach));
  std::vector<double> block_ = std::vector<double>(2 * kBlock);
  std::int64_t block_begin_ = 0;
  std::int64_t used_ = kBlock;  // pairs of the block
};

/// The weight of a sample so many samples before a cut. It falls to 0, so that no cut clicks.
double weight_before_cut(double samples);

}  // namespace piblocks
