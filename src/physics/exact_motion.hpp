// The unfolded motion in exact numbers: a straight line that crosses rays at equal angles.
// In: a TwoBlocks. Out: how many rays the line has crossed, decided beyond doubt.
// Notation: README.md, "The unfolding". Even rays are collisions with the wall, odd ones of the
// blocks.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>

#include "core/real.hpp"

namespace piblocks {

inline bool is_odd(const Integer& ray) { return mpz_odd_p(ray.get_mpz_t()) != 0; }

/// A phase split where floor() has been decided.
struct Phase {
  Integer ray;      ///< index of the last ray crossed: floor(phase)
  double fraction;  ///< phase - ray, in [0, 1]
};

/// The direction of the line in the infinite past or future.
struct Asymptote {
  Integer ray;  ///< the nearest ray on the finite side
  Real beyond;  ///< how far its phase is past that ray, in [0, 1); 0 if the line is parallel to it
};

/// A direction, as a ray and what is beyond it: an end of time, the turn or the start. Rays are
/// counted from the nearest one, which keeps precision.
struct Landmark {
  Integer ray;
  DoubleDouble beyond;
  int sign = 1;  ///< 1 ahead, as the infinite future, -1 behind, as the infinite past

  Landmark() = default;
  Landmark(const Asymptote& asymptote, int side);
  /// Rays from `other` to `ray`: 0 or positive if it is crossed.
  DoubleDouble steps_from(const Integer& other) const;
};

/// One direction as the landmark of the rays before it and of those after it.
struct TwoSided {
  Landmark ahead;
  Landmark behind;

  const Landmark& seen(bool from_later_rays) const { return from_later_rays ? behind : ahead; }
};

/// Longest numbers from which the time of a collision is computed exactly. Longer ones would slow
/// down everything that is computed with that time.
inline constexpr double kShortTime_bits = 256;
/// Precision at which an undecided count is given up.
inline constexpr mpfr_prec_t kMaxDecisionBits = 1 << 22;
/// Relative precision of what the doubles of the closed form are rounded from: two doubles'.
inline constexpr mpfr_prec_t kLandmark_bits = 110;

/// The wedge and both ends of the line in it, all to one precision.
struct Wedge {
  Real sigma;
  Real theta;
  Asymptote past;
  Asymptote future;
};

/// The data are rational; only answers are rounded.
struct ExactMotion {
  explicit ExactMotion(const TwoBlocks& system);

  Rational ratio;             ///< r = m_blue / m_red
  Rational y1, y2;            ///< gaps at time 0
  Rational u1, u2;            ///< their rates: the velocities of blue and red
  Rational areal_velocity;    ///< L = y2 u1 - y1 u2; sigma L/2 is the area swept in a unit of time
  Rational speed_squared;     ///< |V|^2 = r u1^2 + u2^2
  Rational closest_approach;  ///< time at which the line is nearest to the corner
  bool blocks_first;          ///< turning from the blocks' ray on; otherwise mirrored, wall first

  bool at_rest() const { return speed_squared == 0; }
  /// Whether the line goes through the corner, so that every collision happens at closest_approach.
  /// By convention the blocks meet first, as in the limit of a later red block; the wall comes
  /// first where the blocks arrive touching. Seen backwards the same holds for a line that comes
  /// out of the corner.
  bool through_corner() const { return areal_velocity == 0; }

  Real sigma(mpfr_prec_t bits) const { return sqrt(Real(bits, ratio)); }
  /// Every phase is below 2^magnitude().
  long magnitude() const;
  /// Collisions before the ray with this index is crossed and including it.
  Integer count_from_ray(const Integer& ray) const { return blocks_first ? ray : ray + 1; }

  /// All members with a relative error below 2^-bits, also Asymptote::beyond.
  /// @throws SimulationError as total().
  Wedge wedge(mpfr_prec_t bits) const;
  TwoSided turn() const;   ///< the direction of the point nearest to the corner
  TwoSided start() const;  ///< the direction of the point at time 0
  /// Number of collisions at times >= 0: rays crossed at finite times.
  /// @throws SimulationError if kMaxDecisionBits do not decide.
  Integer total() const;
  Integer total(const Asymptote& future) const;
  /// Index of the first ray of all time, counted as by count_from_ray().
  Integer first_index(const Asymptote& past) const;
  /// A time at which this ray has been crossed and the next one has not, for a motion that is not
  /// through_corner() and a ray that is crossed. It is the exact time of the crossing where that is
  /// a short number. Otherwise it is later by at most 2^-100 of the time that the line takes to
  /// pass the corner, and of the time between the crossing and closest_approach.
  /// @throws SimulationError as total().
  Rational time_past(const Integer& ray) const;
  /// For a motion that is not through_corner(). @throws SimulationError as total().
  Phase phase_at(const Rational& t) const;
  /// The phase from the nearest even ray to the point, 0 ... 1, with a relative error below 2^-52.
  /// For a motion that is not through_corner(). @throws SimulationError as total().
  double phase_from_wall(const Rational& t) const;

 private:
  /// Of the point on the line to which `along` = |V|^2 tau belongs.
  Real phase(const Rational& along, const Real& sigma, const Real& theta) const;
  /// q: the phase as t grows without bound; q - pi/theta is that of the infinite past.
  Real final_phase(const Real& sigma, const Real& theta) const;
  /// Precision with which split() begins.
  mpfr_prec_t first_precision(long relative_bits) const {
    return magnitude() + 64 + std::max(relative_bits, 64L);
  }
  /// Splits a phase at its floor, raising the precision until the floor is certain and the rest has
  /// a relative error below 2^-relative_bits, unless these are 0.
  /// @param phase  of (sigma, theta), right to 2^(magnitude() + 6) units of its last place.
  /// @param x, y   a point in its direction, in the frame in which the phase grows.
  template <typename PhaseFunction>
  Asymptote split(const PhaseFunction& phase, const Rational& x, const Rational& y,
                  long relative_bits) const;
  Asymptote future(long relative_bits) const;
  /// Parameters as those of split().
  template <typename PhaseFunction>
  TwoSided two_sided(const PhaseFunction& phase, const Rational& x, const Rational& y) const;
  /// When the line crosses the ray, rounded up by no more than 2^-bits of what time_past() says.
  Rational rounded_crossing(const Integer& ray, mpfr_prec_t bits) const;
  /// x of a point in the frame in which the phase grows.
  Rational mirrored(const Rational& x) const { return blocks_first ? x : Rational(-x); }
};

}  // namespace piblocks
