// Clicks as samples, without the sound of any body.
// In: clacks or collisions. Out: the band-limited pulses they become, added up.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

#include "sound/clack_stream.hpp"
#include "sound/click.hpp"

namespace piblocks::testing_support {

/// One channel, from sample 0 on.
class ClickTrain {
 public:
  explicit ClickTrain(std::size_t size) : pairs_(2 * size), size_(size) {}

  void add(double sample, double height, double softness = 0) {
    const double whole = std::floor(sample);
    const double first = whole - (ClickKernel::kReach - 1);
    if (first < 0 || first + 2 * ClickKernel::kReach > double(size_)) return;
    kernel_.add(sample - whole, softness, height, 0, pairs_.data() + 2 * std::size_t(first));
  }
  std::vector<double> samples() const {
    std::vector<double> result(size_);
    for (std::size_t i = 0; i < size_; ++i) result[i] = pairs_[2 * i];
    return result;
  }

 private:
  ClickKernel kernel_;
  std::vector<double> pairs_;
  std::size_t size_;
};

/// All clacks of a film that shows this, from `from` on at one speed.
inline std::vector<Clack> clacks_of(const PairLog& log, const std::vector<Stretch>& stretches,
                                    const Rational& duration_s) {
  ClackStream stream(log, stretches, duration_s, 48000);
  std::vector<Clack> clacks;
  const long end = ceil(Rational(duration_s * 48000)).get_si();
  for (long sample = 0; sample <= end; sample += 1024) stream.read_until(sample + 1024, clacks);
  return clacks;
}

}  // namespace piblocks::testing_support
