// Engines that go from collision to collision in double precision, recorded.
// In: a BlockSystem. Out: every collision from time 0 on, in the order met.
#pragma once

#include <piblocks/run.hpp>

#include <vector>

#include "physics/stored_log.hpp"

namespace piblocks {

/// The article's event loop: positions are advanced to the next collision of any pair.
/// @throws SimulationError where a number leaves its range, or the rounding of double precision
///         more than doubles the number of collisions.
std::vector<StoredCollision> event_loop(const BlockSystem& system);

/// VelocityLoop.
/// @throws SimulationError as event_loop().
std::vector<StoredCollision> velocity_loop(const BlockSystem& system);

}  // namespace piblocks
