// Blocks that lose energy where they collide, as a collision log: each question costs the same,
// however many collisions there are.
// In: a TwoBlocks with restitutions below 1. Out: any collision, any state.
#pragma once

#include <optional>
#include <utility>

#include "physics/impact.hpp"
#include "physics/inelastic_motion.hpp"

namespace piblocks {

/// Before time 0 the blocks move as they do at time 0: what they lost in earlier collisions is not
/// known. In a run of infinitely many collisions they rest at the wall from the last listed one on.
class InelasticLog final : public PairLog {
 public:
  /// @throws SimulationError as RoundPowers.
  explicit InelasticLog(const System& system);

  PairCollision blocks_collision(const Integer& index) const override;
  PairState blocks_at(const Rational& time) const override;
  State state_at(const Rational& time) const override;
  std::optional<Collapse> collapse(const std::optional<Rational>& until) const override;
  Rational time_after(const Integer& index) const override;
  std::optional<PositionBounds> bounds_at(const Rational& time) const override;
  Gaps gaps_at(const Rational& time) const override;
  Gaps gaps_at_collision(const Integer& index) const override;

  Integer count_at(const Rational& time) const override { return motion_.count_at(time); }

  Integer first_since(const Rational& time) const override;

  std::optional<Impact> blocks_impact(CollisionKind kind, const Integer& first,
                                      const Integer& last) const override;

 private:
  /// Count and gaps at a time.
  std::pair<Integer, InelasticGaps> moved(const Rational& time) const;
  InelasticGaps at_rest() const;
  BlockMotion blue(const Real& gap, const Real& rate) const;
  BlockMotion red(const Real& gap, const Real& rate) const;

  InelasticMotion motion_;
  mpfr_prec_t velocity_bits_;  // what a velocity's difference may cancel, and a double's
  Rational blue_offset_;       // x_blue - y1
  Rational red_offset_;        // x_red - y2
};

}  // namespace piblocks
