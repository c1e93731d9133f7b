// One moment of a run, named by time or by collision.
// In: "3.5", "last" or "#314". Out: the state at it.
#pragma once

#include <piblocks/collision_log.hpp>
#include <piblocks/interpolator.hpp>

#include <string_view>
#include <variant>

namespace piblocks {

/// The instant of the last collision.
struct LastCollision {};
/// The instant of the collision with this index; the state is the one just after it.
struct NthCollision {
  Integer index;
};
/// A time in the scene's unit.
using Instant = std::variant<Rational, LastCollision, NthCollision>;

/// @throws UsageError if the text is no instant.
Instant parse_instant(std::string_view text);

/// The state at an instant, and the instant's time.
struct TimedState {
  Time time;
  BlockState state;
};

/// @throws UsageError if the log has no such collision.
TimedState state_at(const CollisionLog& log, const Instant& instant);

}  // namespace piblocks
