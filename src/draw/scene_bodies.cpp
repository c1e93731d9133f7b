#include "draw/scene_bodies.hpp"

#include <utility>

namespace piblocks {

BodiesState bodies_state(BlockState state) {
  const auto motion = [](const Motion& block) {
    return BodyMotion{{block.position, 0}, {block.velocity, 0}};
  };
  return {std::move(state.count), {motion(state.blue), motion(state.red)}};
}

BlockState blocks_state(const BodiesState& state, const TwoBlocks& blocks) {
  const auto motion = [&](std::size_t body) {
    const auto& [position, velocity] = state.bodies[body];
    return Motion{blocks.side * position[0], blocks.side * velocity[0]};
  };
  return {state.count, motion(blocks.blue_id), motion(blocks.red_id)};
}

}  // namespace piblocks
