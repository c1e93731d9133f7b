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

/// Distance in which clacks are compressed together, nearer ones more.
inline constexpr int kCompressed_samples = 4;

/// The height for an impulse: a small one stays as it is, 1 gives 0.8, 100 gives 3.2, and all are
/// below 8. The sum of the impulses within a sample grows like the mass ratio, without a limit.
double compressed(double impulse);

/// The height of the click for clack `index`. The impulses around it decide how much it is
/// compressed, so that many collisions are as loud as one of their total impulse.
/// @param clacks  in the order of `sample`; all within kCompressed_samples of it are among them
double height(std::span<const Clack> clacks, std::size_t index);

/// A sinc in a Kaiser window: at 48 kHz flat to 18 kHz; from 23 kHz on inaudible, 80 dB down.
class ClickKernel {
 public:
  /// Samples it reaches to both sides.
  static constexpr int kReach = 24;

  ClickKernel();

  /// Adds a pulse with these heights to 2 * kReach pairs of samples. The pulse is `fraction` of a
  /// sample, 0 <= fraction < 1, after the pair with index kReach - 1.
  void add(double fraction, double left, double right, double* samples) const;

 private:
  static constexpr int kPhases = 256;
  std::vector<double> phases_;  // kPhases + 1 rows of 2 * kReach
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
