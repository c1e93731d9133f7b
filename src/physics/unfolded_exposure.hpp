// An interval of time with many collisions, in closed form.
// In: the unfolded motion, and both ends of the interval. Out: an exposure whose integrals cost
// some hundred sines each. Formulas: README.md, "Exposure".
#pragma once

#include <optional>

#include "physics/exposure.hpp"
#include "physics/unfolding.hpp"

namespace piblocks {

/// A ray, or a direction between rays, by its distance from the nearer end of time, in rays.
struct RayPhase {
  double phase = 0;
  bool late = false;  ///< whether the nearer end is the future
};

/// Rays first, first + 2, …, last.
struct RayRange {
  RayPhase first;
  RayPhase last;
};

/// Times between rays, and sums over every other ray between two, at the cost of few.
class RaySums {
 public:
  explicit RaySums(const ClosedForm& form) : form_(form), sine_(form.step.sine) {}

  /// So many rays later; earlier if negative.
  RayPhase later(RayPhase ray, double rays) const;
  bool is_before(const RayPhase& a, const RayPhase& b) const { return rays_between(a, b) > 0; }
  double rays_between(const RayPhase& a, const RayPhase& b) const;
  /// Scaled time since closest approach.
  double tau(const RayPhase& ray) const;
  /// Scaled time from a to b.
  double duration(const RayPhase& a, const RayPhase& b) const;
  /// y1 = y2 where the line crosses an odd ray.
  double contact(const RayPhase& odd_ray) const { return form_.ell * inverse_sine(odd_ray); }
  /// The odd rays of a range whose contact() is at most `gap`, up to a rounding.
  std::optional<RayRange> nearer_than(double gap, const RayRange& odd_rays) const;

  /// The sum of sin theta/sin(delta), delta being the angle of a ray.
  double sum_of_inverse_sines(const RayRange& range) const;
  /// The sum over odd rays of the time integral of y1 from the ray before to the ray after.
  double integral_of_blue(const RayRange& odd_rays) const;
  /// The sum over even rays of the time integral of y2 from the ray before to the ray after.
  double integral_of_red(const RayRange& even_rays) const;

  /// sin theta/sin(delta)
  double inverse_sine(const RayPhase& ray) const;

 private:
  template <typename Summand>
  double sum(const RayRange& range) const;
  template <typename Summand>
  double end_correction(const RayPhase& between) const;
  template <typename Summand>
  double integral(const RayPhase& from, const RayPhase& to) const;
  double angle(const RayPhase& ray) const { return ray.phase * form_.theta.hi; }

  ClosedForm form_;
  double sine_;
};

/// One end of an interval, and the ray inside of the interval that is crossed next to it.
struct IntervalEnd {
  double tau = 0;       ///< scaled time since closest approach
  double blue_gap = 0;  ///< y1
  double red_gap = 0;   ///< y2
  RayPhase ray;
  bool ray_is_odd = false;
};

/// @param begin, end   with many rays between them.
PairExposure expose_bounces(const ClosedForm& form, const IntervalEnd& begin,
                            const IntervalEnd& end);

}  // namespace piblocks
