// The state of one collision, for tests that draw it.
// In: a log and the index of a collision. Out: the state just after it, whose count is the index.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <utility>

namespace piblocks {

inline PairState state_after(const PairLog& log, const Integer& index) {
  const PairCollision collision = log.blocks_collision(index);
  return {index, collision.blue, collision.red};
}

/// The same as a state of bodies, of which blue and red are the first.
inline State bodies_state(PairState state) {
  const auto motion = [](const BlockMotion& block) {
    return Motion{{block.position, 0}, {block.velocity, 0}};
  };
  return {std::move(state.count), {motion(state.blue), motion(state.red)}};
}

inline State bodies_after(const PairLog& log, const Integer& index) {
  return bodies_state(state_after(log, index));
}

}  // namespace piblocks
