// The event loop in exact rational arithmetic, for the few collisions of a light red block.
// In: a BlockSystem with m_red <= m_blue, or one at rest. Out: its collisions, rounded once.
#pragma once

#include <piblocks/blocks.hpp>

#include <vector>

#include "physics/stored_log.hpp"

namespace piblocks {

/// Collisions from time 0 on. With theta >= pi/4 there are at most a handful.
/// @throws SimulationError past a step limit that no such system reaches.
std::vector<StoredCollision> exact_events(const BlockSystem& system);

}  // namespace piblocks
