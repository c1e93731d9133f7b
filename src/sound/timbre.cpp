#include "sound/timbre.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace piblocks {
namespace {

constexpr std::array kWallModes = {Mode{196, 0.055, 0.30}, Mode{443, 0.038, 0.28},
                                   Mode{977, 0.020, 0.18}, Mode{2130, 0.007, 0.12},
                                   Mode{5900, 0.0012, 0.12}};
constexpr std::array kBlockModes = {Mode{1210, 0.022, 0.22}, Mode{2590, 0.014, 0.24},
                                    Mode{4170, 0.007, 0.18}, Mode{6820, 0.0025, 0.16},
                                    Mode{9800, 0.0006, 0.20}};

/// A smaller sound is silence: it is 20 dB below the last of 24 bits. Still smaller numbers would
/// slow processors down.
constexpr double kNothing = 1e-8;

}  // namespace

std::span<const Mode> wall_modes() { return kWallModes; }
std::span<const Mode> block_modes() { return kBlockModes; }

Timbre::Timbre(std::span<const Mode> modes, double rate_hz) {
  for (const Mode& mode : modes) {
    const double radius = std::exp(-1 / (mode.decay_s * rate_hz));
    const double angle = 2 * std::numbers::pi * mode.frequency_hz / rate_hz;
    resonators_.push_back({-radius * radius, 2 * radius * std::cos(angle), mode.height});
  }
}

bool Timbre::is_silent() const {
  const auto is_small = [](const Pair& p) {
    return std::max(std::fabs(p[0]), std::fabs(p[1])) < kNothing;
  };
  return last_click_ == Pair{} && std::ranges::all_of(resonators_, [&](const Resonator& r) {
           return is_small(r.before) && is_small(r.before_last);
         });
}

void Timbre::add(std::span<const double> clicks, std::span<double> sound) {
  const bool no_click = std::ranges::all_of(clicks, [](double click) { return click == 0; });
  if (no_click && is_silent()) {
    for (Resonator& r : resonators_) r.before = r.before_last = {};
    return;
  }
  for (Resonator& r : resonators_) {
    Pair click = last_click_;
    for (std::size_t i = 0; i < clicks.size(); i += 2) {
      for (std::size_t channel = 0; channel < 2; ++channel) {
        const double now = clicks[i + channel];
        const double answer = r.last * r.before[channel] + r.last_but_one * r.before_last[channel] +
                              r.height * (now - click[channel]);
        click[channel] = now;
        r.before_last[channel] = r.before[channel];
        r.before[channel] = answer;
        sound[i + channel] += answer;
      }
    }
  }
  std::copy_n(clicks.end() - 2, 2, last_click_.begin());
}

}  // namespace piblocks
