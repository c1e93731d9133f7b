// An interval of time with many collisions, in closed form.
// In: the unfolded motion, and both ends of the interval. Out: an exposure whose integrals cost
// some hundred sines each. Formulas: README.md, "Exposure".
#pragma once

#include "physics/exposure.hpp"
#include "physics/ray_sums.hpp"

namespace piblocks {

/// Gaps at one instant.
struct Gaps {
  double tau = 0;   ///< scaled time since closest approach
  double blue = 0;  ///< y1
  double red = 0;   ///< y2
};

/// One end of an interval, and the ray inside of the interval that is crossed next to it.
struct IntervalEnd {
  Gaps gaps;
  RayPhase ray;
  bool ray_is_odd = false;
};

/// @param total_phase  as in RaySums.
/// @param begin, end   with many rays between them.
Exposure expose_bounces(const ClosedForm& form, double total_phase, const IntervalEnd& begin,
                        const IntervalEnd& end);

}  // namespace piblocks
