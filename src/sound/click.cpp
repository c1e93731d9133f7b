#include "sound/click.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rounded.hpp"

namespace piblocks {
namespace {

/// Sums of impulses grow like m_red / m_blue, which may be beyond the range of a double.
constexpr double kMost = 1e300;

/// Clacks within this distance sound as one.
constexpr double kTogether_samples = 4;

/// Clacks within kCrowd_samples at 100 a second.
constexpr double kDense = 10;

/// 1 at no distance, falling smoothly to 0 at kTogether_samples.
double nearness(double distance_samples) {
  const double x = distance_samples / kTogether_samples;
  const double bell = std::max(0.0, 1 - x * x);
  return bell * bell;
}

double bounded(double impulse) { return std::min(impulse, kMost); }

/// In parts of the rate: the middle of the slope from 18 to 23 kHz.
constexpr double kSharpCutoff = 20.5 / 48;
constexpr double kSoftCutoff = 4.0 / 48;
/// Shape of the window, for 80 dB.
constexpr double kBeta = 7.857;

/// The modified Bessel function of order 0, by its power series.
double bessel(double x) {
  double sum = 1;
  double term = 1;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    term *= (x / (2 * k)) * (x / (2 * k));
    sum += term;
  }
  return sum;
}

/// How a body rings after a click of height 1: height e^(-t/decay) cos(2 pi frequency t).
struct Mode {
  double frequency_hz;
  double decay_s;  // to 1/e
  double height;
};

constexpr std::array kWallModes = {Mode{196, 0.055, 0.30}, Mode{443, 0.038, 0.28},
                                   Mode{977, 0.020, 0.18}, Mode{2130, 0.007, 0.12},
                                   Mode{5900, 0.0012, 0.12}};
constexpr std::array kBlockModes = {Mode{1210, 0.022, 0.22}, Mode{2590, 0.014, 0.24},
                                    Mode{4170, 0.007, 0.18}, Mode{6820, 0.0025, 0.16},
                                    Mode{9800, 0.0006, 0.20}};

/// Less, 20 dB below the last of 24 bits, is silence. Tiny numbers would slow processors down.
constexpr double kNothing = 1e-8;

}  // namespace

double loudness(double impulse) {
  // arsinh x = ln(1 + x + x^2/(1 + sqrt(1 + x^2)))
  const double x = bounded(impulse);
  const double knee = rounded::log1p(x + x * (x / (1 + rounded::hypot(1, x))));
  return 1 + knee / (1 + knee);
}

Click click(std::span<const Clack> clacks, std::size_t index) {
  const double sample = clacks[index].sample;
  const double own = bounded(clacks[index].impulse);
  if (own == 0) return {};
  const auto within = [&](double distance) {
    const auto first = std::ranges::lower_bound(clacks, sample - distance, {}, &Clack::sample);
    const auto last = std::ranges::upper_bound(clacks, sample + distance, {}, &Clack::sample);
    return std::span(first, last);
  };
  const std::span<const Clack> near = within(kTogether_samples);
  double together = 0;
  for (const Clack& clack : near) {
    together += nearness(clack.sample - sample) * bounded(clack.impulse);
  }
  const double crowd = 1 + double(within(kCrowd_samples).size() - near.size());
  return {.height = std::min(loudness(together), std::sqrt(kDense / crowd)) * (own / together),
          .softness = std::clamp(crowd / kDense - 1, 0.0, 1.0)};
}

double sinc(double x) {
  const double angle = std::numbers::pi * x;
  return angle == 0 ? 1 : rounded::sin(angle) / angle;
}

double kaiser(double x, double beta) {
  const double inside = 1 - x * x;
  return inside < 0 ? 0 : bessel(beta * std::sqrt(inside)) / bessel(beta);
}

ClickKernel::ClickKernel() {
  for (int phase = 0; phase <= kPhases; ++phase) {
    for (int tap = 0; tap < 2 * kReach; ++tap) {
      const double distance = tap - (kReach - 1) - double(phase) / kPhases;
      const double window = kaiser(distance / kReach, kBeta);
      const auto pulse = [&](double cutoff) {
        return 2 * cutoff * sinc(2 * cutoff * distance) * window;
      };
      phases_.push_back({.sharp = pulse(kSharpCutoff), .soft = pulse(kSoftCutoff)});
    }
  }
}

void ClickKernel::add(double fraction, double softness, double left, double right,
                      double* samples) const {
  const double place = fraction * kPhases;
  const int phase = int(place);
  const double part = place - phase;
  const Tap* const low = phases_.data() + std::ptrdiff_t{phase} * 2 * kReach;
  const Tap* const high = low + 2 * kReach;
  for (int tap = 0; tap < 2 * kReach; ++tap) {
    const double before = low[tap].at(softness);
    const double value = before + part * (high[tap].at(softness) - before);
    samples[2 * tap] += left * value;
    samples[2 * tap + 1] += right * value;
  }
}

Timbre::Timbre(CollisionKind kind, double rate_hz) {
  for (const Mode& mode : kind == CollisionKind::wall ? kWallModes : kBlockModes) {
    const double radius = rounded::exp(-1 / (mode.decay_s * rate_hz));
    const double angle = 2 * std::numbers::pi * mode.frequency_hz / rate_hz;
    resonators_.push_back({-radius * radius, 2 * radius * rounded::cos(angle), mode.height});
  }
}

bool Timbre::is_silent() const {
  const auto is_small = [](const StereoSample& p) {
    return std::max(std::fabs(p[0]), std::fabs(p[1])) < kNothing;
  };
  return last_click_ == StereoSample{} && std::ranges::all_of(resonators_, [&](const Resonator& r) {
           return is_small(r.y1) && is_small(r.y2);
         });
}

void Timbre::add(std::span<const double> clicks, std::span<double> sound) {
  const bool no_click = std::ranges::all_of(clicks, [](double click) { return click == 0; });
  if (no_click && is_silent()) {
    for (Resonator& r : resonators_) r.y1 = r.y2 = {};
    return;
  }
  for (Resonator& r : resonators_) {
    StereoSample click = last_click_;
    for (std::size_t i = 0; i < clicks.size(); i += 2) {
      for (std::size_t channel = 0; channel < 2; ++channel) {
        const double now = clicks[i + channel];
        const double answer =
            r.a1 * r.y1[channel] + r.a2 * r.y2[channel] + r.gain * (now - click[channel]);
        click[channel] = now;
        r.y2[channel] = r.y1[channel];
        r.y1[channel] = answer;
        sound[i + channel] += answer;
      }
    }
  }
  std::copy_n(clicks.end() - 2, 2, last_click_.begin());
}

}  // namespace piblocks
