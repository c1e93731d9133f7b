#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "physics/impact.hpp"
#include "physics/inelastic_motion.hpp"
#include "physics/logs.hpp"

namespace piblocks {
namespace {

constexpr const char* kName = "restitution";
/// A Time has 106 bits, a double 53.
constexpr mpfr_prec_t kTime_bits = 120;
constexpr mpfr_prec_t kPosition_bits = 160;

/// The sum, or 0 if it is only the rounding of the gap.
double position(const Real& gap, const Rational& offset) {
  if (offset == 0) return gap.to_double();
  constexpr long kNoise_bits = kPosition_bits - 6;
  const Real start(gap.bits(), offset);
  const Real sum = start + gap;
  return start.exponent() - sum.exponent() > kNoise_bits ? 0 : sum.to_double();
}

/// Each question costs the same, however many collisions there are.
///
/// Before time 0 the blocks move as they do at time 0: what they lost in earlier collisions is not
/// known. In a run of infinitely many collisions they rest at the wall from the last listed one on.
class InelasticLog final : public PairLog {
 public:
  explicit InelasticLog(const System& system)
      : PairLog(system),
        motion_(blocks()),
        // Beside the velocity of blue that of red is as small as their mass ratio.
        velocity_bits_(kPosition_bits + std::labs(Real(64, motion_.ratio).exponent())),
        blue_offset_(blocks().wall_face + blocks().blue.width / 2),
        red_offset_(blocks().wall_face + blocks().blue.width + blocks().red.width / 2) {
    set_range(1, motion_.listed);
  }

  PairState blocks_at(const Rational& time) const override {
    const auto [count, now] = moved(time);
    PairState state{count, blue(now.y1, now.u1), red(now.y2, now.u2)};
    require_finite(to_time(time), state.blue, state.red, kName);
    return state;
  }

  State state_at(const Rational& time) const override {
    State state = PairLog::state_at(time);
    state.is_infinite = motion_.is_end(state.count);
    return state;
  }

  std::optional<Collapse> collapse(const std::optional<Rational>& until) const override {
    const bool is_endless = !motion_.total && (!until || count_at(*until) == last());
    return is_endless ? collapse_of(blocks()) : std::nullopt;
  }

  PairCollision blocks_collision(const Integer& index) const override {
    const InelasticNumbers now = motion_.numbers(index, velocity_bits_ + 8);
    PairCollision collision{
        index, (now.reach / now.speed).to_double_double(), motion_.kind(index), {}, {}};
    const InelasticGaps after =
        motion_.is_end(index) ? at_rest() : motion_.gaps_after(index, now, velocity_bits_);
    collision.blue = blue(after.y1, after.u1);
    collision.red = red(after.y2, after.u2);
    require_finite(collision.time, collision.blue, collision.red, kName);
    return collision;
  }

  Rational time_after(const Integer& index) const override {
    if (motion_.coincides_from(index)) require_last(index, last());
    return motion_.time_past(index);
  }

  Integer first_since(const Rational& time) const override {
    const Integer last = motion_.count_at(time);
    if (last < 1) return 1;
    // In the corner, in which all collisions from the third at the latest happen, times are exact.
    for (Integer first = 1; first <= 3 && first <= last; ++first) {
      if (!motion_.coincides_from(first)) continue;
      return motion_.time_past(first) == time ? first : Integer(last + 1);
    }
    const bool is_then = collision_time(last) == to_time(time) || motion_.time_past(last) == time;
    return is_then ? last : Integer(last + 1);
  }

  std::optional<Impact> blocks_impact(CollisionKind kind, const Integer& first,
                                      const Integer& last) const override {
    Integer from = motion_.kind(first) == kind ? first : Integer(first + 1);
    const Integer to = motion_.kind(last) == kind ? last : Integer(last - 1);
    if (from > to) return std::nullopt;
    const InelasticSums sums = motion_.sums(from, to, kTime_bits);
    // In the unit of Impact, with the energy at time 0.
    const Rational speed_squared = motion_.ratio * motion_.rates.first * motion_.rates.first +
                                   motion_.rates.second * motion_.rates.second;
    Rational factor = (1 + motion_.restitution(kind)) / 2;
    if (kind == CollisionKind::wall) factor *= 1 + motion_.ratio;
    const Real impulse =
        Real(kTime_bits, factor) * sums.speeds / sqrt(Real(kTime_bits, speed_squared));
    const Integer middle = from + (to - from) / 4 * 2;
    return Impact{kind, (sums.reaches / sums.speeds).to_double_double(), impulse.to_double(),
                  blocks_collision(middle).blue.position};
  }

  std::optional<PositionBounds> bounds_at(const Rational& time) const override {
    // Rounded once, from numbers of kPosition_bits and more.
    constexpr double kRoundoff = 0x1p-53 * (1 + 0x1p-40);
    const auto bound = [](const BlockMotion& block, const Rational& offset) {
      return kRoundoff * std::fabs(block.position) + 0x1p-150 * std::fabs(to_double(offset));
    };
    const PairState now = blocks_at(time);
    return PositionBounds{bound(now.blue, blue_offset_), bound(now.red, red_offset_)};
  }

  Gaps gaps_at(const Rational& time) const override {
    const InelasticGaps now = moved(time).second;
    return {now.y1.to_double(), now.y2.to_double()};
  }

  Gaps gaps_at_collision(const Integer& index) const override {
    if (motion_.is_end(index)) return {};
    const InelasticGaps now = motion_.gaps_after(index, kTime_bits);
    return {now.y1.to_double(), now.y2.to_double()};
  }

  Integer count_at(const Rational& time) const override { return motion_.count_at(time); }

 private:
  /// Count and gaps at a time.
  std::pair<Integer, InelasticGaps> moved(const Rational& time) const {
    if (motion_.collides && time >= motion_.first_time) {
      auto state = motion_.state_at(time, velocity_bits_);
      if (motion_.is_end(state.first)) state.second = at_rest();
      return state;
    }
    const auto& [y1, y2] = motion_.gaps;
    const auto& [u1, u2] = motion_.rates;
    const auto real = [this](const Rational& value) { return Real(velocity_bits_, value); };
    return {0, {real(y1 + u1 * time), real(y2 + u2 * time), real(u1), real(u2)}};
  }

  InelasticGaps at_rest() const {
    const Real zero(velocity_bits_, 0);
    return {zero, zero, zero, zero};
  }

  BlockMotion blue(const Real& gap, const Real& rate) const {
    return {position(gap, blue_offset_), rate.to_double()};
  }
  BlockMotion red(const Real& gap, const Real& rate) const {
    return {position(gap, red_offset_), rate.to_double()};
  }

  InelasticMotion motion_;
  mpfr_prec_t velocity_bits_;  // what a velocity's difference may cancel, and a double's
  Rational blue_offset_;       // x_blue - y1
  Rational red_offset_;        // x_red - y2
};

}  // namespace

std::unique_ptr<PairLog> make_inelastic_log(const System& system) {
  return std::make_unique<InelasticLog>(system);
}

}  // namespace piblocks
