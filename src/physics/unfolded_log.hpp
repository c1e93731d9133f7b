// The closed form as a collision log: every question costs the same, however many collisions.
// In: a BlockSystem whose red block is heavier than the blue one. Out: any collision, any state.
#pragma once

#include <piblocks/blocks.hpp>
#include <piblocks/collision_log.hpp>

#include "physics/exact_motion.hpp"

namespace piblocks {

/// Largest |log2(m_red/m_blue)| for which positions can be computed: beyond it the wedge angle
/// leaves the range of a double.
inline constexpr long kMaxRatioExponent = 2000;

/// Two-sided closed form. The phase is measured from the nearer end of time: near either end
/// the angle still to go is small and so is its rounding error, and where the angle is not
/// small the blocks are near the wall and a phase error moves them little. A double is thereby
/// enough for positions at any number of digits: |dy1| <= 8 u (R + ell), |dy2| <= 8 u R, with
/// u = 2^-53, R the distance from the corner and ell = |L|/|V|.
class UnfoldedLog final : public CollisionLog {
 public:
  /// @throws UsageError if the mass ratio is beyond 2^kMaxRatioExponent.
  explicit UnfoldedLog(const BlockSystem& system);

  const Integer& size() const override { return size_; }
  Collision at(const Integer& index) const override;
  FreeFlight flight_at(const Rational& time) const override;

 private:
  /// One end of time: phase = whole + fraction as t goes to minus or plus infinity.
  struct End {
    Integer whole;
    double fraction = 0;
    int sign = 1;  // of t
  };
  /// A point on the line as one end sees it.
  struct Sighting {
    const End* end = nullptr;
    double tau = 0;       // scaled time since closest approach
    double distance = 0;  // R
    double phase = 0;     // minus end->whole
    bool decided = false;
  };

  Sighting sight(const Rational& time) const;
  Integer ray_of(const Integer& index) const { return exact_.blocks_first ? index : index - 1; }
  DecidedPhase decide(const Sighting& seen, const Rational& time) const;
  void set_velocities(const End& end, const Integer& ray, FreeFlight& flight) const;
  void set_positions(const Integer& ray, double fraction, double distance,
                     FreeFlight& flight) const;

  ExactMotion exact_;
  Integer size_;
  Integer ray_before_corner_;  // last ray crossed before and after a line through_corner()
  Integer ray_after_corner_;
  // Time is counted in units of 2^time_exponent_, which makes the speed about 1.
  long time_exponent_ = 0;
  double sigma_ = 0;
  double theta_ = 0;
  double impact_ = 0;      // b: distance of the line from the corner
  double speed_ = 0;       // |V| in scaled time
  Time closest_approach_;  // in scaled time
  End past_;
  End future_;
  double blue_offset_ = 0;  // x_blue - y1
  double red_offset_ = 0;   // x_red - y2
};

}  // namespace piblocks
