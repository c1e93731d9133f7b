// Sums over many rays of the unfolded motion, at the cost of few.
// In: the wedge and two rays. Out: times between rays, and sums over every other ray between them.
// Formulas: README.md, "Exposure".
#pragma once

#include <optional>

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

class RaySums {
 public:
  /// @param total_phase  rays from end to end of time: pi/theta.
  RaySums(const ClosedForm& form, double total_phase)
      : form_(form), sine_(form.step.sine), total_(total_phase) {}

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
  double total_;
};

}  // namespace piblocks
