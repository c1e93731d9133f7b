// The state of one collision, for tests that draw it.
// In: a log and the index of a collision. Out: the state just after it, whose count is the index.
#pragma once

#include <piblocks/run.hpp>

namespace piblocks {

inline BlockState state_after(const CollisionLog& log, const Integer& index) {
  const Collision collision = log.blocks_collision(index);
  return {index, collision.blue, collision.red};
}

}  // namespace piblocks
