// The closed form's numbers, rounded from exact ones, and its formulas.
// In: an ExactMotion. Out: the directions of rays as seen from the corner, and the collisions on
// them. Notation and error bounds: README.md.
#pragma once

#include <piblocks/time.hpp>

#include <cmath>
#include <optional>

#include "physics/exact_motion.hpp"

namespace piblocks {

/// Largest |log2(m_red/m_blue)| for which positions can be computed: beyond it the wedge angle
/// leaves the range of a double.
inline constexpr long kMaxRatioExponent = 2000;

/// Stands for all greater distances along the line, in units of ell: the angle to go is then far
/// below anything that matters.
inline constexpr double kFarAway = 0x1p1000;

/// A number as hi + lo; what Time is for instants.
using DoubleDouble = Time;

inline bool is_odd(const Integer& ray) { return mpz_odd_p(ray.get_mpz_t()) != 0; }

/// One end of time. Its phase is beyond that of `ray`: past it for the infinite future, before it
/// for the infinite past.
struct RoundedAsymptote {
  Integer ray;
  DoubleDouble beyond;
  int sign = 1;  ///< of t

  /// Rays from `other` to `ray`: 0 or positive if it is crossed.
  DoubleDouble steps_from(const Integer& other) const;
};

/// Sine and cosine of an angle.
struct Direction {
  double sine;
  double cosine;

  friend Direction operator+(const Direction& a, const Direction& b) {
    return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
  }
};

/// What the parity of a ray says: on an even one blue meets the wall, on an odd one red.
struct RayKind {
  double blue_reach;  ///< y1/R
  double red_reach;   ///< y2/R
  double side;        ///< 1, or -1 if the reflected blue block moves the other way
};

/// A Collision but for its index and kind.
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
  Direction step{};               ///< of theta
  double ell = 0;                 ///< |L|/|V|
  double impact = 0;              ///< b = sigma ell: distance of the line from the corner
  double speed = 0;               ///< |V| in scaled time
  double passage = 0;             ///< b/|V| in scaled time: what the turn takes
  double speed_over_ell = 0;      ///< 0 for a line through the corner
  DoubleDouble closest_approach;  ///< in scaled time
  double time_unit = 0;           ///< a power of two
  double red_speed = 0;           ///< |V|
  double blue_speed = 0;          ///< |V|/sigma
  double blue_offset = 0;         ///< x_blue - y1
  double red_offset = 0;          ///< x_red - y2

  /// The direction of a ray, as an angle from the end of time that is `steps` and `beyond` away.
  /// With theta and the phase to twice a double's precision only the last roundings count.
  Direction direction(const DoubleDouble& steps, const DoubleDouble& beyond) const {
    DoubleDouble phase = two_sum(steps.hi, beyond.hi);
    phase.lo += steps.lo + beyond.lo;
    DoubleDouble angle = two_product(phase.hi, theta.hi);
    angle.lo += phase.hi * theta.lo + phase.lo * theta.hi;
    const double sine = std::sin(angle.hi);
    const double cosine = std::cos(angle.hi);
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

  /// The collision on a ray.
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

/// The time of a collision on the right side of time 0, past which only rounding can carry it.
/// @param contact  index of the collision that happens exactly at time 0, if one does.
inline Time time_within(const Integer& index, const std::optional<Integer>& contact,
                        const Time& time) {
  const bool is_wrong = index > 0 ? time.hi < 0 : time.hi > 0;
  return is_wrong || (contact && index == *contact) ? Time{} : time;
}

struct Unfolding : ClosedForm {
  /// @throws SimulationError if ell, or the time it takes, is too small for a double, but not 0.
  Unfolding(const BlockSystem& system, const ExactMotion& exact, const Wedge& wedge);

  /// Distance along the line from where it is nearest to the corner, in units of ell and
  /// at most kFarAway, for a line that is not through the corner. @param tau  scaled time since
  /// then
  double ahead(double tau) const;

  RoundedAsymptote past;
  RoundedAsymptote future;
};

}  // namespace piblocks
