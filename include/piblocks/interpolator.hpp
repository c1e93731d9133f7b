// Where the blocks are at one instant.
// In: a collision log and an exact time. Out: positions, velocities and the count.
// Motion between collisions is uniform, so linear interpolation is exact.
#pragma once

#include <piblocks/collision_log.hpp>

namespace piblocks {

/// What a frame needs to know of the physics.
struct BlockState {
  Integer count;  ///< collisions so far
  Motion blue;
  Motion red;
};

/// The state at `time`. Before the first and after the last collision the motion goes on with
/// its velocity, as far as one likes.
BlockState state_at(const CollisionLog& log, const Rational& time);

/// The state just after the collision with this index, so that its count is `index`.
/// @throws UsageError unless 1 <= index <= log.size().
BlockState state_after(const CollisionLog& log, const Integer& index);

}  // namespace piblocks
