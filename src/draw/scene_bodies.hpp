// The bodies of a scene, also where it has two blocks and a wall.
// In: a scene; states. Out: bodies; states of bodies.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include "physics/exposure.hpp"

namespace piblocks {

BodiesState bodies_state(BlockState state);
/// The two blocks of a state, as seen from what is immovable beside them.
BlockState blocks_state(const BodiesState& state, const TwoBlocks& blocks);

}  // namespace piblocks
