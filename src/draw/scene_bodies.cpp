#include "draw/scene_bodies.hpp"

#include <utility>

namespace piblocks {

State bodies_state(PairState state) {
  const auto motion = [](const BlockMotion& block) {
    return Motion{{block.position, 0}, {block.velocity, 0}};
  };
  return {std::move(state.count), {motion(state.blue), motion(state.red)}};
}

PairState blocks_state(const State& state, const TwoBlocks& blocks) {
  const auto motion = [&](std::size_t body) {
    const auto& [position, velocity] = state.bodies[body];
    return BlockMotion{blocks.side * position[0], blocks.side * velocity[0]};
  };
  return {state.count, motion(blocks.blue_id), motion(blocks.red_id)};
}

}  // namespace piblocks
