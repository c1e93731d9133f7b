// The article's event loop in double precision, recorded.
// In: a BlockSystem. Out: every collision from time 0 on, in the order met.
#pragma once

#include <piblocks/blocks.hpp>

#include <vector>

#include "physics/stored_log.hpp"

namespace piblocks {

/// @throws SimulationError past kMaxStoredCollisions, or where a number leaves its range.
std::vector<StoredCollision> event_loop(const BlockSystem& system);

}  // namespace piblocks
