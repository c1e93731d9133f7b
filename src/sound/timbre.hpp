// What a clack sounds like: a body that rings in a few damped modes.
// In: clicks. Out: the body's answer to them.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace piblocks {

/// How a body rings after a click of height 1: height e^(-t/decay) cos(2 pi frequency t).
struct Mode {
  double frequency_hz;
  double decay_s;  ///< to 1/e
  double height;
};

/// Dull.
std::span<const Mode> wall_modes();
/// Bright.
std::span<const Mode> block_modes();

/// Two channels of one body. Each mode is a resonator with two poles. The difference of the clicks
/// drives it, so that a steady push makes no sound.
class Timbre {
 public:
  Timbre(std::span<const Mode> modes, double rate_hz);

  /// Adds the answer to pairs of samples.
  void add(std::span<const double> clicks, std::span<double> sound);

 private:
  using Pair = std::array<double, 2>;
  struct Resonator {
    double last_but_one = 0;  ///< factors of the answers before
    double last = 0;
    double height = 0;
    Pair before_last{};
    Pair before{};
  };

  bool is_silent() const;

  std::vector<Resonator> resonators_;
  Pair last_click_{};
};

}  // namespace piblocks
