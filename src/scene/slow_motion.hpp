// Windows of slow motion as plain intervals of simulation time.
// In: a scene, its log, the span that is shown. Out: intervals inside the span, in order, apart.
#pragma once

#include <piblocks/collision_log.hpp>
#include <piblocks/scene.hpp>

#include <vector>

namespace piblocks {

/// Half-open: from <= time < to.
struct SlowWindow {
  Rational from;
  Rational to;
  Rational factor;
};

/// The exact time of a moment. @param key  named in the message.
/// @throws UsageError if it is that of a turn or a last collision, and there is none.
Rational time_of(const Moment& moment, const char* key, const Scene& scene,
                 const CollisionLog& log);

/// @throws UsageError as time_of(), or if windows overlap or end before they begin.
std::vector<SlowWindow> slow_windows(const Scene& scene, const CollisionLog& log,
                                     const Rational& from, const Rational& to);

}  // namespace piblocks
