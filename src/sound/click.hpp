// How high a clack's click is, and its form between two samples.
// In: clacks with their impulses, in order. Out: band-limited pulses in the samples around them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sound/clack_stream.hpp"

namespace piblocks {

/// Clacks closer than this are compressed together, nearer ones more.
inline constexpr int kTogether_samples = 4;

/// The height for an impulse: a small one stays as it is, 1 gives 0.8, 100 gives 3.2, and all are
/// below 8. The sum of the impulses within a sample grows like the mass ratio, without a limit.
double compressed(double impulse);

/// The height of the click for clack `index`. The impulses around it decide how much it is
/// compressed, so that many collisions are as loud as one of their total impulse.
/// @param clacks  in the order of `sample`; all within kTogether_samples of it are among them
double height(std::span<const Clack> clacks, std::size_t index);

/// A sinc in a Kaiser window: flat to 18 kHz at a rate of 48 kHz, and 80 dB down from 23 kHz on, so
/// that aliasing is inaudible.
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

}  // namespace piblocks
