#include "sound/click.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace piblocks {
namespace {

/// Sums of impulses grow like m_red / m_blue, which may be beyond the range of a double.
constexpr double kMost = 1e300;

constexpr double kHighest = 8;

/// 1 at no distance, falling smoothly to 0 at kTogether_samples.
double nearness(double distance_samples) {
  const double x = distance_samples / kTogether_samples;
  const double bell = std::max(0.0, 1 - x * x);
  return bell * bell;
}

double bounded(double impulse) { return std::min(impulse, kMost); }

/// In parts of the rate: the middle of the slope from 18 to 23 kHz.
constexpr double kCutoff = 20.5 / 48;
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

}  // namespace

double compressed(double impulse) {
  const double knee = std::asinh(bounded(impulse));
  return knee / (1 + knee / kHighest);
}

double height(std::span<const Clack> clacks, std::size_t index) {
  const double sample = clacks[index].sample;
  const double own = bounded(clacks[index].impulse);
  if (own == 0) return 0;
  double together = own;
  for (std::size_t i = index; i-- > 0 && sample - clacks[i].sample < kTogether_samples;) {
    together += nearness(sample - clacks[i].sample) * bounded(clacks[i].impulse);
  }
  for (std::size_t i = index + 1;
       i < clacks.size() && clacks[i].sample - sample < kTogether_samples; ++i) {
    together += nearness(clacks[i].sample - sample) * bounded(clacks[i].impulse);
  }
  return compressed(together) * (own / together);
}

double sinc(double x) {
  const double angle = std::numbers::pi * x;
  return angle == 0 ? 1 : std::sin(angle) / angle;
}

double kaiser(double x, double beta) {
  const double inside = 1 - x * x;
  return inside < 0 ? 0 : bessel(beta * std::sqrt(inside)) / bessel(beta);
}

ClickKernel::ClickKernel() {
  for (int phase = 0; phase <= kPhases; ++phase) {
    for (int tap = 0; tap < 2 * kReach; ++tap) {
      const double distance = tap - (kReach - 1) - double(phase) / kPhases;
      phases_.push_back(2 * kCutoff * sinc(2 * kCutoff * distance) *
                        kaiser(distance / kReach, kBeta));
    }
  }
}

void ClickKernel::add(double fraction, double left, double right, double* samples) const {
  const double place = fraction * kPhases;
  const int phase = static_cast<int>(place);
  const double part = place - phase;
  const double* const low = phases_.data() + std::ptrdiff_t{phase} * 2 * kReach;
  const double* const high = low + 2 * kReach;
  for (int tap = 0; tap < 2 * kReach; ++tap) {
    const double value = low[tap] + part * (high[tap] - low[tap]);
    samples[2 * tap] += left * value;
    samples[2 * tap + 1] += right * value;
  }
}

}  // namespace piblocks
