// What a clack sounds like: a pulse in the samples, and a body that rings in a few damped modes.
// In: clacks with their impulses, in order. Out: band-limited clicks, and the body's answer.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sound/clack_stream.hpp"

namespace piblocks {

/// Left and right.
using StereoSample = std::array<double, 2>;

/// Distance on either side, 50 ms, in which clacks are counted.
inline constexpr int kCrowd_samples = 2400;

/// The height for an impulse: 1 for the weakest, 1.5 for 1, 1.8 for 100, and below 2 for all. The
/// sum of the impulses within a sample grows like the mass ratio, without a limit.
double loudness(double impulse);

struct Click {
  double height = 0;
  double softness = 0;  ///< 0: sharp, 1: without what is above 4 kHz
};

/// The click for clack `index`. Clacks within 4 samples are as loud as one of their total impulse.
/// From 100 clacks a second on their heights fall, so that their power stays the same, and they
/// become softer; from 200 a second on they are soft.
/// @param clacks  in the order of `sample`; all within kCrowd_samples of it are among them
Click click(std::span<const Clack> clacks, std::size_t index);

/// A sinc in a Kaiser window. At 48 kHz the sharp one is flat to 18 kHz, and from 23 kHz on
/// inaudible, 80 dB down; the soft one is 6 dB down at 4 kHz and 80 dB from 6.5 kHz on.
class ClickKernel {
 public:
  /// Samples it reaches to both sides.
  static constexpr int kReach = 24;

  ClickKernel();

  /// Adds a pulse with these heights to 2 * kReach pairs of samples. The pulse is `fraction` of a
  /// sample, 0 <= fraction < 1, after the pair with index kReach - 1.
  void add(double fraction, double softness, double left, double right, double* samples) const;

 private:
  static constexpr int kPhases = 256;
  struct Tap {
    double sharp;
    double soft;

    double at(double softness) const { return sharp + softness * (soft - sharp); }
  };
  std::vector<Tap> phases_;  // kPhases + 1 rows of 2 * kReach
};

/// sin(pi x)/(pi x).
double sinc(double x);
/// Kaiser's window of shape beta: 1 at 0, 0 outside of -1 … 1 (Kaiser & Schafer, 1980).
double kaiser(double x, double beta);

/// Two channels of one body, the dull wall or the bright blocks. Each mode is a resonator with two
/// poles. The difference of the clicks drives it, so that a steady push makes no sound.
class Timbre {
 public:
  Timbre(CollisionKind kind, double rate_hz);

  /// Adds the answer to pairs of samples.
  void add(std::span<const double> clicks, std::span<double> sound);

 private:
  struct Resonator {
    // answer = a1 * y1 + a2 * y2 + gain * input
    double a2 = 0;
    double a1 = 0;
    double gain = 0;
    StereoSample y2{};  ///< the answer before y1
    StereoSample y1{};  ///< the last answer
  };

  bool is_silent() const;

  std::vector<Resonator> resonators_;
  StereoSample last_click_{};
};

}  // namespace piblocks
