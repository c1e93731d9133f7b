// The state of one collision, for tests that draw it.
// In: a log and the index of a collision. Out: the state just after it, whose count is the index.
#pragma once

#include <piblocks/two_blocks.hpp>

namespace piblocks {

inline PairState state_after(const PairLog& log, const Integer& index) {
  const PairCollision collision = log.blocks_collision(index);
  return {index, collision.blue, collision.red};
}

}  // namespace piblocks
