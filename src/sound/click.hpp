// How high a clack's click is, and its form between two samples.
// In: clacks with their impulses, in order. Out: band-limited pulses in the samples around them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sound/clack_stream.hpp"

namespace piblocks {

/// Clacks closer than this are heard together, the less the farther apart.
inline constexpr int kTogether_samples = 4;

/// What becomes of an impulse: of a small one itself, of 1 0.8, of 100 3.2, and of none 8 or more.
/// Those that come within one sample grow like the mass ratio, without limit in the number of
/// digits.
double compressed(double impulse);

/// The height of the click for clack `index`. The impulses around it decide how much it is
/// compressed, so that a crowd of collisions is as loud as one blow of all of them.
/// @param clacks  those within kTogether_samples of it included, in the order of `sample`.
double height(std::span<const Clack> clacks, std::size_t index);

/// A sinc in a Kaiser window: even to 18 kHz at a rate of 48 kHz; 80 dB down from 23 kHz on, so
/// that nothing is folded back that could be heard.
class ClickKernel {
 public:
  /// Samples it reaches to both sides.
  static constexpr int kReach = 24;

  ClickKernel();

  /// The pulse of height 1 at `fraction` of a sample, 0 <= fraction < 1, multiplied by `left` and
  /// `right`, is added to the pairs of samples from `samples` on: 2 * kReach of them, of which the
  /// one with index kReach - 1 is at fraction 0.
  void add(double fraction, double left, double right, double* samples) const;

 private:
  static constexpr int kPhases = 256;
  std::vector<double> phases_;  // kPhases + 1 rows of 2 * kReach
};

/// sin(pi x)/(pi x).
double sinc(double x);
/// Kaiser's window of shape beta: 1 at 0, 0 outside of -1 … 1 (Kaiser & Schafer, 1980).
double kaiser(double x, double beta);

}  // namespace piblocks
