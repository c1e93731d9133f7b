// The order of the stages: clacks -> heights -> clicks -> timbre -> weights.
#include "sound/run_sound.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/rounded.hpp"

namespace piblocks {
namespace {

/// The weakest clack alone peaks at -14 dB or higher, on both sides.
constexpr double kVolume = 0.42;

/// Left and right differ by at most 3 dB.
constexpr double kWidest = 0.107;

ClackStream stream_of(const Voice& voice, int rate_hz) {
  // How much later the voice begins than its first whole sample of the film.
  const Rational later_s =
      voice.begin_s - Rational(to_integer(RunSound::first_sample(voice, rate_hz))) / rate_hz;
  std::vector<Stretch> stretches = voice.stretches;
  for (Stretch& stretch : stretches) stretch.video_s += later_s;
  return {voice.log, stretches, voice.end_s - voice.begin_s + later_s, rate_hz};
}

}  // namespace

RunSound::RunSound(const Voice& voice, const Rational& film_s, int rate_hz)
    : view_low_(to_double(voice.scene.view.x.low)),
      view_width_(to_double(voice.scene.view.x.high - voice.scene.view.x.low)),
      left_(voice.left),
      width_(voice.right - voice.left),
      sample_(first_sample(voice, rate_hz)),
      rise_(in_samples(voice.rise, rate_hz)),
      fall_(in_samples(voice.fall, rate_hz)),
      stream_(stream_of(voice, rate_hz)),
      wall_(CollisionKind::wall, rate_hz),
      blocks_(CollisionKind::blocks, rate_hz) {
  if (voice.end_s < film_s) end_ = to_double(voice.end_s * rate_hz);
}

std::int64_t RunSound::first_sample(const Voice& voice, int rate_hz) {
  return floor(Rational(voice.begin_s * rate_hz)).get_si();
}

RunSound::SampleRamp RunSound::in_samples(const std::optional<Ramp>& ramp, int rate_hz) {
  if (!ramp) return {};
  return {to_double(ramp->begin_s * rate_hz), to_double(ramp->end_s * rate_hz)};
}

/// The weights of left and right, of equal power from one edge of the frame to the other.
StereoSample RunSound::channels(const Clack& clack) const {
  const double in_view = (clack.position - view_low_) / view_width_;
  const double x = left_ + width_ * std::clamp(in_view, 0.0, 1.0);
  const double angle = std::numbers::pi / 2 * (0.5 + kWidest * (2 * x - 1));
  const auto [sine, cosine] = rounded::sin_cos(angle);
  return {cosine, sine};
}

/// Adds the clicks that reach into the block.
void RunSound::add_clicks() {
  const std::int64_t end = block_begin_ + kBlock + kReach;
  const auto known = std::ptrdiff_t(clacks_.size());
  stream_.read_until(end + kCrowd_samples, clacks_);
  // Clacks of both kinds within an eighth of a sample are out of order.
  std::stable_sort(clacks_.begin() + known, clacks_.end(),
                   [](const Clack& a, const Clack& b) { return a.sample < b.sample; });
  for (; clicked_ < clacks_.size() && clacks_[clicked_].sample < double(end); ++clicked_) {
    const Clack& clack = clacks_[clicked_];
    const auto [height, softness] = click(clacks_, clicked_);
    const double volume = kVolume * height;
    const StereoSample side = channels(clack);
    const double whole = std::floor(clack.sample);
    const auto first = std::int64_t(whole) - (kReach - 1);
    const std::int64_t at = first - (block_begin_ - kReach);
    std::vector<double>& clicks = clack.kind == CollisionKind::wall ? wall_clicks_ : block_clicks_;
    kernel_.add(clack.sample - whole, softness, volume * side[0], volume * side[1],
                clicks.data() + 2 * at);
  }
  const auto done =
      std::find_if(clacks_.begin(), clacks_.begin() + std::ptrdiff_t(clicked_),
                   [&](const Clack& clack) { return clack.sample > double(end) - kCrowd_samples; });
  clicked_ -= std::size_t(done - clacks_.begin());
  clacks_.erase(clacks_.begin(), done);
}

void RunSound::make_block() {
  add_clicks();
  std::ranges::fill(block_, 0.0);
  for (auto [timbre, clicks] :
       {std::pair{&wall_, &wall_clicks_}, std::pair{&blocks_, &block_clicks_}}) {
    timbre->add(std::span(*clicks).subspan(2 * kReach, 2 * kBlock), block_);
    std::copy(clicks->begin() + 2 * kBlock, clicks->end(), clicks->begin());
    std::fill(clicks->end() - 2 * kBlock, clicks->end(), 0.0);
  }
  block_begin_ += kBlock;
  used_ = 0;
}

double RunSound::weight() const {
  const auto along = [&](const SampleRamp& ramp) {
    return std::clamp((double(sample_) - ramp.begin) / (ramp.end - ramp.begin), 0.0, 1.0);
  };
  double weight = rise_.begin < rise_.end ? along(rise_) : 1;
  if (fall_.begin < fall_.end) return weight * (1 - along(fall_));
  return weight * weight_before_cut(end_ - double(sample_));
}

StereoSample RunSound::next() {
  if (used_ == kBlock) make_block();
  const auto at = std::size_t(2 * used_);
  const double factor = weight();
  ++used_;
  ++sample_;
  return {factor * block_[at], factor * block_[at + 1]};
}

double weight_before_cut(double samples) {
  constexpr double kLength = 240;  // 5 ms
  const double rest = samples / kLength;
  return rest >= 1 ? 1 : (1 - rounded::cos(std::numbers::pi * rest)) / 2;
}

}  // namespace piblocks
