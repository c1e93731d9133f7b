// A click between two samples.
// In: its time and height. Out: a band-limited pulse in the samples around it.
#pragma once

#include <cstdint>
#include <vector>

namespace piblocks {

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
