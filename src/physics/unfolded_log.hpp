// The closed form as a collision log: every question costs the same, however many collisions.
// In: a TwoBlocks whose red block is heavier than the blue one. Out: any collision, any state.
#pragma once

#include <memory>
#include <optional>

#include "physics/exact_motion.hpp"
#include "physics/impact.hpp"
#include "physics/unfolding.hpp"

namespace piblocks {

/// Doubles are enough for positions at any number of digits (README.md, "Why doubles are enough").
class UnfoldedLog final : public PairLog {
 public:
  /// @throws UsageError if the mass ratio is beyond 2^2000.
  /// @throws SimulationError if the blocks pass the corner closer than a double can tell.
  explicit UnfoldedLog(const System& system);

  PairCollision blocks_collision(const Integer& index) const override;
  PairState blocks_at(const Rational& time) const override;
  Rational time_after(const Integer& index) const override;
  std::unique_ptr<PairStream> stream(const Integer& first, const Integer& last) const override;
  std::optional<PositionBounds> bounds_at(const Rational& time) const override;
  Gaps gaps_at(const Rational& time) const override;
  double y2_bound_at(const Rational& time) const override;
  Gaps gaps_at_collision(const Integer& index) const override;

  std::optional<Impact> blocks_impact(CollisionKind kind, const Integer& first,
                                      const Integer& last) const override;
  Integer count_near(const Time& time) const override;
  PairExposure expose(const Rational& first, const Rational& last) const override;

 private:
  /// A point on the line, seen from the nearer end of time.
  struct LinePoint {
    Time time;       // as a double-double
    double tau = 0;  // scaled, since closest approach
    const Landmark* end = nullptr;
    double distance = 0;  // R
    double sine = 0;      // of the angle from the line of sight to that end
    double cosine = 1;
    const Integer* ray = nullptr;  // next to the nearest landmark: an end, the turn or the start
    double phase = 0;              // minus that ray
    bool decided = false;          // whether the rounding of the phase cannot change its floor
  };

  /// Scaled time since closest approach, as near as double-doubles tell.
  double tau_near(const Time& t) const;
  /// The same, rounded once. `t` is the time as a double-double.
  double tau_at(const Rational& time, const Time& t) const;
  LinePoint point_at(double tau, const Time& t) const;
  LinePoint point_at(const Rational& time) const {
    const Time rounded = to_time(time);
    return point_at(tau_at(time, rounded), rounded);
  }
  /// Computed exactly if the phase of the point is not decided.
  Phase phase_of(const LinePoint& point, const Rational& time) const;
  PairState state_of(const LinePoint& point, const Phase& at, const Rational& time) const;
  PairExposure expose_corner(const Rational& begin, const Rational& end) const;
  /// A ray as seen from the nearer end of time.
  struct RayView {
    const Landmark* end = nullptr;
    Direction ray{};
  };
  /// The ray half-way between two.
  RayView view_of(const Integer& from, const Integer& to) const;
  Time time(const Integer& from, const Integer& to, const RayView& view) const;
  RayPhase ray_phase(const Integer& ray) const;
  Integer ray_of(const Integer& index) const { return exact_.blocks_first ? index : index - 1; }

  ExactMotion exact_;
  Unfolding form_;
  std::optional<Integer> contact_;  // index of the collision that happens exactly at time 0
};

}  // namespace piblocks
