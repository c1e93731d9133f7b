// The bodies of a scene, also where it has two blocks and a wall.
// In: a scene; states. Out: bodies; states of bodies.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include "physics/exposure.hpp"

namespace piblocks {

State bodies_state(PairState state);
/// The two blocks of a state, as seen from what is immovable beside them.
PairState blocks_state(const State& state, const TwoBlocks& blocks);

}  // namespace piblocks
