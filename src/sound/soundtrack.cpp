// The order of the stages: clacks -> heights -> clicks -> timbre -> limiter.
#include <piblocks/soundtrack.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sound/clack_stream.hpp"
#include "sound/click_kernel.hpp"
#include "sound/limiter.hpp"
#include "sound/loudness.hpp"
#include "sound/timbre.hpp"

namespace piblocks {
namespace {

constexpr std::int64_t kBlock = 1024;  // pairs
constexpr std::int64_t kReach = ClickKernel::kReach;

/// A clack of impulse 1 alone peaks at about a fifth of full scale.
constexpr double kVolume = 0.28;
/// -2.5 dB: encoders that lose something add up to 1 dB to the peaks.
constexpr double kCeiling = 0.75;
/// The film's end would cut off what still rings.
constexpr std::int64_t kFade = 240;

std::int64_t to_nearest(const Rational& value) {
  return floor(Rational(value + Rational(1, 2))).get_si();
}

}  // namespace

struct Soundtrack::State {
  State(const Scene& scene, const CollisionLog& log, std::span<const Stretch> stretches,
        const Rational& duration_s)
      : size(to_nearest(duration_s * kRate_hz)),
        view_low(to_double(scene.view.x.low)),
        view_width(to_double(scene.view.x.high - scene.view.x.low)),
        half_blue(to_double(scene.system.blue.width) / 2),
        stream(log, stretches, duration_s, kRate_hz) {
    // Time goes by in the limiter before the first sample leaves it.
    for (int i = 0; i < Limiter::kDelay; ++i) next_limited();
  }

  /// Left and right of a contact: of equal power from one edge of the view to the other, neither
  /// ever silent.
  Limiter::Pair channels(const Clack& clack) const {
    const double side = clack.kind == CollisionKind::wall ? -half_blue : half_blue;
    const double x = (clack.blue_position + side - view_low) / view_width;
    const double angle = std::numbers::pi / 2 * (0.15 + 0.7 * std::clamp(x, 0.0, 1.0));
    return {std::cos(angle), std::sin(angle)};
  }

  void add_clicks();
  void make_block();
  Limiter::Pair next_limited();

  std::int64_t size;
  double view_low;
  double view_width;
  double half_blue;
  ClackStream stream;
  ClickKernel kernel;
  Timbre wall{wall_modes(), kRate_hz};
  Timbre blocks{block_modes(), kRate_hz};
  Limiter limiter{kCeiling, kRate_hz};

  std::vector<Clack> clacks;  // those that are not done with
  std::size_t clicked = 0;    // of them, how many are in the clicks
  // Pairs of samples from block_begin - kReach on, as far as clicks reach.
  std::vector<double> wall_clicks = std::vector<double>(2 * (kBlock + 3 * kReach));
  std::vector<double> block_clicks = std::vector<double>(2 * (kBlock + 3 * kReach));
  std::vector<double> block = std::vector<double>(2 * kBlock);
  std::int64_t block_begin = 0;
  std::int64_t used = kBlock;  // pairs of the block
  std::int64_t given = 0;      // pairs of the whole
};

/// All whose click reaches into the block.
void Soundtrack::State::add_clicks() {
  const std::int64_t end = block_begin + kBlock + kReach;
  stream.read_until(end + kTogether_samples, clacks);
  // The two kinds of one eighth of a sample, and what rounding did.
  std::stable_sort(clacks.begin() + std::ptrdiff_t(clicked), clacks.end(),
                   [](const Clack& a, const Clack& b) { return a.sample < b.sample; });
  for (; clicked < clacks.size() && clacks[clicked].sample < double(end); ++clicked) {
    const Clack& clack = clacks[clicked];
    const double volume = kVolume * height(clacks, clicked);
    const Limiter::Pair side = channels(clack);
    const double whole = std::floor(clack.sample);
    const auto first = std::int64_t(whole) - (kReach - 1);
    const std::int64_t at = first - (block_begin - kReach);
    std::vector<double>& clicks = clack.kind == CollisionKind::wall ? wall_clicks : block_clicks;
    kernel.add(clack.sample - whole, volume * side[0], volume * side[1], clicks.data() + 2 * at);
  }
  const auto done = std::find_if(
      clacks.begin(), clacks.begin() + std::ptrdiff_t(clicked),
      [&](const Clack& clack) { return clack.sample > double(end) - kTogether_samples; });
  clicked -= std::size_t(done - clacks.begin());
  clacks.erase(clacks.begin(), done);
}

void Soundtrack::State::make_block() {
  add_clicks();
  std::ranges::fill(block, 0.0);
  for (auto [timbre, clicks] :
       {std::pair{&wall, &wall_clicks}, std::pair{&blocks, &block_clicks}}) {
    timbre->add(std::span(*clicks).subspan(2 * kReach, 2 * kBlock), block);
    std::copy(clicks->begin() + 2 * kBlock, clicks->end(), clicks->begin());
    std::fill(clicks->end() - 2 * kBlock, clicks->end(), 0.0);
  }
  block_begin += kBlock;
  used = 0;
}

Limiter::Pair Soundtrack::State::next_limited() {
  if (used == kBlock) make_block();
  const auto at = static_cast<std::size_t>(2 * used);
  const Limiter::Pair raw{block[at], block[at + 1]};
  ++used;
  return limiter.next(raw);
}

Soundtrack::Soundtrack(const Scene& scene, const CollisionLog& log,
                       std::span<const Stretch> stretches, const Rational& duration_s)
    : state_(std::make_unique<State>(scene, log, stretches, duration_s)) {}
Soundtrack::~Soundtrack() = default;

std::int64_t Soundtrack::size() const noexcept { return state_->size; }

std::size_t Soundtrack::read(std::span<float> samples) {
  State& s = *state_;
  std::size_t count = 0;
  for (; 2 * count + 1 < samples.size() && s.given < s.size; ++count, ++s.given) {
    const Limiter::Pair pair = s.next_limited();
    const double rest = double(s.size - s.given) / double(kFade);
    const double fade = rest >= 1 ? 1 : (1 - std::cos(std::numbers::pi * rest)) / 2;
    samples[2 * count] = float(fade * pair[0]);
    samples[2 * count + 1] = float(fade * pair[1]);
  }
  return count;
}

}  // namespace piblocks
