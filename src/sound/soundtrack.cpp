// The order of the stages: runs -> mix -> leveller -> limiter.
#include "sound/soundtrack.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/rounded.hpp"

namespace piblocks {
namespace {

/// Time in which the reduction falls to 1/e.
constexpr double kRecovery_s = 0.05;

/// The interpolated signal between samples up to 1 is not higher than this.
constexpr double kOvershoot = 2.7;

constexpr double kLimiterBeta = 6;

constexpr double kAsGoodAsOne = 1 - 1e-5;

/// -2.5 dB: lossy encoders add up to 0.4 dB to the peaks.
constexpr double kCeiling = 0.75;

/// Weighted energy of 0.4 s at -16.5 LUFS: 10^((-16.5 + 0.691)/10) in a pair.
constexpr double kMostEnergy = 0.02625 * 19200;

/// A hop with less energy counts as silence and resets the filters: tiny numbers would slow
/// processors down.
constexpr double kSilence = 1e-20;

void check(std::span<const Stretch> stretches) {
  const bool is_in_order = std::ranges::is_sorted(stretches, {}, &Stretch::video_s);
  if (!stretches.empty() && stretches.front().video_s == 0 && is_in_order) return;
  throw UsageError("sound: stretches of a film must begin at 0 s and be in its order");
}

}  // namespace

/// ITU-R BS.1770-4, table 1.
double Leveller::Weighting::next(double x) {
  const double y = 1.53512485958697 * x - 2.69169618940638 * x1 + 1.19839281085285 * x2 +
                   1.69065929318241 * y1 - 0.73248077421585 * y2;
  x2 = x1;
  x1 = x;
  y2 = y1;
  y1 = y;
  return y;
}

/// Takes the hop that just ended in, and lets the next one out.
void Leveller::end_hop() {
  if (energy_ < kSilence) weighted_ = {};
  hops_[oldest_] = energy_;
  windows_[oldest_] = std::accumulate(hops_.begin(), hops_.end(), 0.0);
  oldest_ = (oldest_ + 1) % kWindow;
  energy_ = 0;
  // All these windows contain the hop of which both neighbours are known now.
  const double most = std::ranges::max(windows_);
  const double hop_gain = most > kMostEnergy ? std::sqrt(kMostEnergy / most) : 1;
  from_ = to_;
  to_ = std::min(hop_gain_, hop_gain);
  hop_gain_ = hop_gain;
}

StereoSample Leveller::next(const StereoSample& pair) {
  const double part = double(place_ % kHop) / kHop;
  const double gain = from_ + part * (to_ - from_);
  const StereoSample out{gain * pairs_[place_][0], gain * pairs_[place_][1]};
  pairs_[place_] = pair;
  for (std::size_t channel = 0; channel < 2; ++channel) {
    const double weighted = weighted_[channel].next(pair[channel]);
    energy_ += weighted * weighted;
  }
  if (++place_ % kHop == 0) end_hop();
  if (place_ == pairs_.size()) place_ = 0;
  return out;
}

Limiter::Limiter(double ceiling, double rate_hz)
    : ceiling_(ceiling), recovery_(1 - rounded::exp(-1 / (kRecovery_s * rate_hz))) {
  for (int phase = 0; phase < kPhases; ++phase) {
    for (int tap = 0; tap < kTaps; ++tap) {
      const double distance = tap - (kHalf - 1) - double(phase) / kPhases;
      kernel_[std::size_t(phase)][std::size_t(tap)] =
          sinc(distance) * kaiser(distance / kHalf, kLimiterBeta);
    }
  }
}

/// The highest value between this sample and the next.
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

StereoSample Limiter::next(const StereoSample& pair) {
  pairs_[std::size_t(count_) % kRing] = pair;
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

Soundtrack::Soundtrack(std::vector<Voice> voices, const Rational& duration_s)
    : duration_s_(duration_s),
      size_(floor(Rational(duration_s * kRate_hz + Rational(1, 2))).get_si()),
      voices_(std::move(voices)),
      limiter_(kCeiling, kRate_hz) {
  for (const Voice& voice : voices_) check(voice.stretches);
  find_next_voice();
  // Time goes by in both before the first sample leaves them.
  for (int i = 0; i < Leveller::kDelay + Limiter::kDelay; ++i) next_limited();
}

void Soundtrack::find_next_voice() {
  next_begin_ = begun_ < voices_.size() ? RunSound::first_sample(voices_[begun_], kRate_hz)
                                        : std::numeric_limits<std::int64_t>::max();
}

StereoSample Soundtrack::next_limited() {
  for (; next_begin_ <= mixed_; find_next_voice()) {
    playing_.emplace_back(voices_[begun_++], duration_s_, kRate_hz);
  }
  StereoSample sum{};
  for (RunSound& run : playing_) {
    const StereoSample pair = run.next();
    sum[0] += pair[0];
    sum[1] += pair[1];
  }
  playing_.remove_if([](const RunSound& run) { return run.is_over(); });
  ++mixed_;
  return limiter_.next(leveller_.next(sum));
}

std::size_t Soundtrack::read(std::span<float> samples) {
  std::size_t count = 0;
  for (; 2 * count + 1 < samples.size() && given_ < size_; ++count, ++given_) {
    const StereoSample pair = next_limited();
    const double weight = weight_before_cut(double(size_ - given_));
    samples[2 * count] = float(weight * pair[0]);
    samples[2 * count + 1] = float(weight * pair[1]);
  }
  return count;
}

}  // namespace piblocks
