// Where the blocks are at one instant.
// In: a collision log and an exact time. Out: positions, velocities and the count.
// Motion between collisions is uniform, so linear interpolation is exact.
#pragma once

#include <piblocks/collision_log.hpp>

namespace piblocks {

/// What a frame needs to know of the physics.
struct BlockState {
  Integer count;  ///< index of the last collision so far, as CollisionLog counts
  Motion blue;
  Motion red;
};

/// The state at `time`. Before the first and after the last collision the motion goes on with
/// its velocity, as far as one likes.
BlockState state_at(const CollisionLog& log, const Rational& time);

}  // namespace piblocks
