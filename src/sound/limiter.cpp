#include "sound/limiter.hpp"

#include <algorithm>
#include <cmath>

#include "sound/click.hpp"

namespace piblocks {
namespace {

/// Time in which the reduction falls to 1/e.
constexpr double kRecovery_s = 0.05;

/// The interpolated signal between samples up to 1 is not higher than this.
constexpr double kOvershoot = 2.7;

constexpr double kLimiterBeta = 6;

constexpr double kAsGoodAsOne = 1 - 1e-5;

}  // namespace

Limiter::Limiter(double ceiling, double rate_hz)
    : ceiling_(ceiling), recovery_(1 - std::exp(-1 / (kRecovery_s * rate_hz))) {
  for (int phase = 0; phase < kPhases; ++phase) {
    for (int tap = 0; tap < kTaps; ++tap) {
      const double distance = tap - (kHalf - 1) - double(phase) / kPhases;
      kernel_[std::size_t(phase)][std::size_t(tap)] =
          sinc(distance) * kaiser(distance / kHalf, kLimiterBeta);
    }
  }
}

/// The highest between this sample and the next.
double Limiter::peak_around(std::int64_t number) const {
  double peak = 0;
  for (const auto& taps : kernel_) {
    for (int channel = 0; channel < 2; ++channel) {
      double value = 0;
      for (int tap = 0; tap < kTaps; ++tap) {
        value += taps[std::size_t(tap)] * at(number - (kHalf - 1) + tap, channel);
      }
      peak = std::max(peak, std::fabs(value));
    }
  }
  return peak;
}

Limiter::Pair Limiter::next(const Pair& pair) {
  pairs_[static_cast<std::size_t>(count_) % kRing] = pair;
  if (std::max(std::fabs(pair[0]), std::fabs(pair[1])) * kOvershoot > ceiling_) last_high_ = count_;

  // The greatest gain of the samples on both sides of an interval.
  const std::int64_t judged = count_ - kHalf;
  const double peak = count_ - last_high_ < kTaps ? peak_around(judged) : 0;
  const double allowed = peak > ceiling_ ? ceiling_ / peak : 1;
  const double before = gain(judged - 1);
  gain(judged) = std::min(allowed, before + (1 - before) * recovery_);
  gain(judged - 1) = std::min(before, allowed);
  if (gain(judged) > kAsGoodAsOne) gain(judged) = 1;
  if (gain(judged) < 1) last_below_one_ = judged;

  // The mean of kTurn lowest gains; this sample is within the reach of each.
  static_assert(kDelay == kHalf + kTurn + 1);
  const std::int64_t now = judged - kTurn - 1;
  double applied = 1;
  if (judged - last_below_one_ <= 2 * kTurn + 2) {
    double low = 1;
    for (int i = 0; i < kTurn; ++i) low = std::min(low, gain(now + i));
    lowest(now) = low;
    double sum = 0;
    for (int i = 0; i < kTurn; ++i) sum += lowest(now - i);
    applied = sum / kTurn;
  } else {
    lowest(now) = 1;
  }
  ++count_;
  return {applied * at(now, 0), applied * at(now, 1)};
}

}  // namespace piblocks
