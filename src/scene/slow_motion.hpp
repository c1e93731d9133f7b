// Windows of slow motion as plain intervals of simulation time.
// In: a scene, its log, the span that is shown. Out: intervals inside the span, in order, apart.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <vector>

#include "scene/schedule.hpp"

namespace piblocks {

/// Half-open: from <= time < to.
struct SlowWindow {
  Rational from;
  Rational to;
  Rational factor;
};

/// time_of(instant, log) for the value of a key, which messages name.
Rational time_of(const Instant& instant, const char* key, const CollisionLog& log);

/// @throws UsageError as time_of(), if windows overlap or end before they begin, or if one that the
///         scene names is outside of the span.
std::vector<SlowWindow> slow_windows(const Scene& scene, const CollisionLog& log, const Span& span);

}  // namespace piblocks
