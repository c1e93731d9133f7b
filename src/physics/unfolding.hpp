// The closed form's numbers, rounded from exact ones, and its formulas.
// In: an ExactMotion. Out: the directions of rays as seen from the corner, and the collisions on
// them; streams and exposures of these. Notation and error bounds: README.md.
#pragma once

#include <piblocks/exact.hpp>

#include <cmath>
#include <memory>
#include <optional>

#include "core/rounded.hpp"
#include "core/two_sum.hpp"
#include "physics/exact_motion.hpp"

namespace piblocks {

/// Stands for all greater distances along the line, in units of ell: the angle to the end of time
/// is then far below anything that matters.
inline constexpr double kFarAway = 0x1p1000;

inline Integer floor_mean(const Integer& a, const Integer& b) {
  Integer result;
  mpz_fdiv_q_2exp(result.get_mpz_t(), Integer(a + b).get_mpz_t(), 1);
  return result;
}

/// Sine and cosine of an angle.
struct Direction {
  double sine;
  double cosine;

  /// Of the complement to a right angle.
  Direction complement() const { return {cosine, sine}; }

  friend Direction operator+(const Direction& a, const Direction& b) {
    return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
  }
};

/// On an even ray blue meets the wall, on an odd one red.
struct RayKind {
  double blue_reach;  ///< y1/R
  double red_reach;   ///< y2/R
  double side;        ///< 1, or -1 if the reflected blue block moves the other way
};

/// A Collision without its index and kind.
struct CollisionNumbers {
  double time_hi;
  double time_lo;
  double blue_position;
  double blue_velocity;
  double red_position;
  double red_velocity;
};

/// What every collision is computed from. Scaled time is t/time_unit, in which ell takes about 1.
struct ClosedForm {
  double sigma = 0;
  DoubleDouble theta;
  double total_phase = 0;         ///< rays from end to end of time: pi/theta
  Direction step{};               ///< of theta
  double ell = 0;                 ///< |L|/|V|
  double corner_distance = 0;     ///< b = sigma ell: distance of the line from the corner
  double speed = 0;               ///< |V| in scaled time
  double passage = 0;             ///< b/|V| in scaled time: what the turn takes
  double speed_over_ell = 0;      ///< 0 for a line through the corner
  double start_range = 0;         ///< |P|/|V| at time 0, in scaled time
  DoubleDouble closest_approach;  ///< in scaled time
  double time_unit = 0;           ///< a power of two
  double red_speed = 0;           ///< |V|
  double blue_speed = 0;          ///< |V|/sigma
  double blue_offset = 0;         ///< x_blue - y1
  double red_offset = 0;          ///< x_red - y2

  /// The angle from a ray to a landmark that is `steps` and `beyond` away.
  /// With theta and the phase to twice a double's precision only the last roundings count.
  Direction direction(const DoubleDouble& steps, const DoubleDouble& beyond) const {
    DoubleDouble phase = two_sum(steps.hi, beyond.hi);
    phase.lo += steps.lo + beyond.lo;
    DoubleDouble angle = two_product(phase.hi, theta.hi);
    angle.lo += phase.hi * theta.lo + phase.lo * theta.hi;
    const auto [sine, cosine] = rounded::sin_cos(angle.hi);
    return {sine + cosine * angle.lo, cosine - sine * angle.lo};
  }

  RayKind kind(bool odd) const {
    return odd ? RayKind{step.cosine, step.cosine, -1} : RayKind{0, 1, 1};
  }

  /// When the line crosses a ray of this direction from the end of time that has this sign.
  Time time(double sign, const Direction& ray) const {
    const DoubleDouble sum =
        two_sum(closest_approach.hi, sign * (passage * (ray.cosine / ray.sine)));
    const DoubleDouble scaled = two_sum(sum.hi, sum.lo + closest_approach.lo);
    return {scaled.hi * time_unit, scaled.lo * time_unit};
  }

  /// The same time by the triangle of the corner and the points at time 0 and at that time. Its
  /// relative error is a few roundings, however far away closest approach is.
  /// @param side        sign of the time
  /// @param from_start  direction of the ray from that of the point at time 0
  /// @param ray         as in time()
  double time_from_start(double side, const Direction& from_start, const Direction& ray) const {
    return side * (start_range * (from_start.sine / ray.sine)) * time_unit;
  }

  /// The angle of the point since time 0, for a scaled time that is nearer to 0 than to closest
  /// approach, so that nothing cancels.
  double angle_since_start(double now) const {
    const double share = now / start_range;
    return rounded::atan2(share * (passage / start_range),
                          1 - share * (closest_approach.hi / start_range));
  }

  /// @param sign  of the end of time
  /// @param ray   direction of the ray, from that end
  /// @param even  direction of the next ray with an even index, from that end
  CollisionNumbers collision(double sign, const Direction& ray, const Direction& even,
                             const RayKind& kind) const {
    const double reach = sigma / ray.sine;  // R/ell
    const double distance = ell * reach;
    const auto [hi, lo] = time(sign, ray);
    return {hi,
            lo,
            blue_offset + kind.blue_reach * distance,
            kind.side * (blue_speed * even.sine),
            red_offset + kind.red_reach * distance,
            sign * (red_speed * even.cosine)};
  }
};

struct Unfolding : ClosedForm {
  /// @throws SimulationError if ell, or the time it takes, is too small for a double, but not 0.
  Unfolding(const TwoBlocks& system, const ExactMotion& exact);

  /// Distance along the line since closest approach, in units of ell and at most kFarAway, for a
  /// line that is not through the corner. @param tau  scaled time since then
  double distance_at(double tau) const;

  /// Whether a ray is nearer to the future than to the past.
  bool is_late(const Integer& ray) const { return ray > turn.ahead.ray; }
  /// Whether a ray is crossed nearer to time 0 than to closest approach.
  bool is_near_start(const Integer& ray) const {
    return near_start != NearStart::none && (ray <= half_way) == (near_start == NearStart::until);
  }
  const Landmark& end_near(bool late) const { return late ? future : past; }
  Integer first_index;  ///< as PairLog has them
  Integer size;
  Landmark past;
  Landmark future;
  TwoSided turn;   ///< closest approach
  TwoSided start;  ///< time 0
  /// Which rays are near the start: until `half_way`, or those after it.
  enum class NearStart { none, until, after } near_start = NearStart::none;
  Integer half_way;
};

/// Rays in the order of time.
struct RaySpan {
  Integer first;
  Integer last;
  Integer index;  ///< of the collision on `first`
};

/// The closed form as a bulk producer.
/// @param contact  index of the collision that happens exactly at time 0, if one does.
std::unique_ptr<PairStream> make_unfolded_stream(const Unfolding& form, const RaySpan& rays,
                                                 const std::optional<Integer>& contact);

/// A ray, or a direction between rays, by its distance from the nearer end of time, in rays.
struct RayPhase {
  double phase = 0;
  bool late = false;  ///< whether the nearer end is the future
};

/// One end of an interval, and the ray inside of the interval that is crossed next to it.
struct IntervalEnd {
  double tau = 0;       ///< scaled time since closest approach
  double blue_gap = 0;  ///< y1
  double red_gap = 0;   ///< y2
  RayPhase ray;
  bool ray_is_odd = false;
};

/// The exposure of an interval with many rays, in closed form. Its integrals cost some hundred
/// sines each. Formulas: README.md, "Exposure".
PairExposure expose_bounces(const ClosedForm& form, const IntervalEnd& begin,
                            const IntervalEnd& end);

}  // namespace piblocks
