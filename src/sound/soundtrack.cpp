// The order of the stages: runs -> mix -> limiter.
#include "sound/soundtrack.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace piblocks {
namespace {

/// -2.5 dB: encoders that lose something add up to 1.1 dB to the peaks.
constexpr double kCeiling = 0.75;

std::int64_t to_nearest(const Rational& value) {
  return floor(Rational(value + Rational(1, 2))).get_si();
}

void check(std::span<const Stretch> stretches) {
  const bool is_in_order = std::ranges::is_sorted(stretches, {}, &Stretch::video_s);
  if (!stretches.empty() && stretches.front().video_s == 0 && is_in_order) return;
  throw UsageError("sound: stretches of a film must begin at 0 s and be in its order");
}

}  // namespace

Soundtrack::Soundtrack(std::vector<Voice> voices, const Rational& duration_s)
    : duration_s_(duration_s),
      size_(to_nearest(duration_s * kRate_hz)),
      voices_(std::move(voices)),
      limiter_(kCeiling, kRate_hz) {
  for (const Voice& voice : voices_) check(voice.stretches);
  find_next_voice();
  // Time goes by in the limiter before the first sample leaves it.
  for (int i = 0; i < Limiter::kDelay; ++i) next_limited();
}

void Soundtrack::find_next_voice() {
  next_begin_ = begun_ < voices_.size() ? RunSound::first_sample(voices_[begun_], kRate_hz)
                                        : std::numeric_limits<std::int64_t>::max();
}

Limiter::Pair Soundtrack::next_limited() {
  for (; next_begin_ <= mixed_; find_next_voice()) {
    playing_.emplace_back(voices_[begun_++], duration_s_, kRate_hz);
  }
  Limiter::Pair sum{};
  for (RunSound& run : playing_) {
    const RunSound::Pair pair = run.next();
    sum[0] += pair[0];
    sum[1] += pair[1];
  }
  playing_.remove_if([](const RunSound& run) { return run.is_over(); });
  ++mixed_;
  return limiter_.next(sum);
}

std::size_t Soundtrack::read(std::span<float> samples) {
  std::size_t count = 0;
  for (; 2 * count + 1 < samples.size() && given_ < size_; ++count, ++given_) {
    const Limiter::Pair pair = next_limited();
    const double weight = weight_before_cut(double(size_ - given_));
    samples[2 * count] = float(weight * pair[0]);
    samples[2 * count + 1] = float(weight * pair[1]);
  }
  return count;
}

}  // namespace piblocks
