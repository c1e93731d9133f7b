#include "sound/click_kernel.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace piblocks {
namespace {

/// Of the rate; half-way down the slope from 18 to 23 kHz.
constexpr double kCutoff = 20.5 / 48;
/// For 80 dB.
constexpr double kClickBeta = 7.857;

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
                        kaiser(distance / kReach, kClickBeta));
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
