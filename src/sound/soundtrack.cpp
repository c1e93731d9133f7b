// The order of the stages: runs -> mix -> limiter.
#include "sound/soundtrack.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <limits>
#include <list>
#include <utility>

#include "sound/limiter.hpp"
#include "sound/run_sound.hpp"

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

struct Soundtrack::State {
  State(std::vector<Voice> all, Rational length_s)
      : duration_s(std::move(length_s)),
        size(to_nearest(duration_s * kRate_hz)),
        voices(std::move(all)) {
    for (const Voice& voice : voices) check(voice.stretches);
    find_next();
    // Time goes by in the limiter before the first sample leaves it.
    for (int i = 0; i < Limiter::kDelay; ++i) next_limited();
  }

  void find_next();
  Limiter::Pair next_limited();

  Rational duration_s;
  std::int64_t size;
  std::vector<Voice> voices;
  std::size_t begun = 0;        // of the voices
  std::int64_t next_begin = 0;  // pair with which the next one begins
  std::list<RunSound> heard;    // at this moment
  Limiter limiter{kCeiling, kRate_hz};
  std::int64_t mixed = 0;  // pairs that went into the limiter
  std::int64_t given = 0;  // pairs of the whole
};

void Soundtrack::State::find_next() {
  next_begin = begun < voices.size() ? RunSound::first_sample(voices[begun], kRate_hz)
                                     : std::numeric_limits<std::int64_t>::max();
}

Limiter::Pair Soundtrack::State::next_limited() {
  for (; next_begin <= mixed; find_next()) {
    heard.emplace_back(voices[begun++], duration_s, kRate_hz);
  }
  Limiter::Pair sum{};
  for (RunSound& run : heard) {
    const RunSound::Pair pair = run.next();
    sum[0] += pair[0];
    sum[1] += pair[1];
  }
  heard.remove_if([](const RunSound& run) { return run.is_over(); });
  ++mixed;
  return limiter.next(sum);
}

Soundtrack::Soundtrack(std::vector<Voice> voices, const Rational& duration_s)
    : state_(std::make_unique<State>(std::move(voices), duration_s)) {}

Soundtrack::Soundtrack(const Scene& scene, const CollisionLog& log,
                       std::span<const Stretch> stretches, const Rational& duration_s)
    : Soundtrack({Voice{.scene = scene,
                        .log = log,
                        .stretches = {stretches.begin(), stretches.end()},
                        .end_s = duration_s}},
                 duration_s) {}
Soundtrack::~Soundtrack() = default;

std::int64_t Soundtrack::size() const noexcept { return state_->size; }

std::size_t Soundtrack::read(std::span<float> samples) {
  State& s = *state_;
  std::size_t count = 0;
  for (; 2 * count + 1 < samples.size() && s.given < s.size; ++count, ++s.given) {
    const Limiter::Pair pair = s.next_limited();
    const double weight = weight_before_cut(double(s.size - s.given));
    samples[2 * count] = float(weight * pair[0]);
    samples[2 * count + 1] = float(weight * pair[1]);
  }
  return count;
}

}  // namespace piblocks
