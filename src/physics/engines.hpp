// Engines that go from collision to collision and hold all of them in memory.
// In: a BlockSystem. Out: its log.
#pragma once

#include <piblocks/run.hpp>

#include <memory>
#include <string>
#include <vector>

namespace piblocks {

/// The event loop in exact rational arithmetic, for the few collisions of a light red block. Every
/// answer is rounded once.
/// @param system  with m_red <= m_blue, or at rest.
std::unique_ptr<CollisionLog> make_exact_log(const BlockSystem& system);
bool is_exact(const CollisionLog& log);

/// Engine::events, which advances positions to the next collision of any pair, or
/// Engine::velocities, a VelocityLoop, in double precision.
/// @throws UsageError if the collisions are more than kMaxStoredCollisions.
/// @throws SimulationError if a number leaves its range, or the rounding of double precision more
///         than doubles the number of collisions.
std::unique_ptr<CollisionLog> make_stored_log(const BlockSystem& system, Engine engine);

/// Name and version of each library of numbers that is linked, such as "MPFR 4.2.0".
std::vector<std::string> physics_library_versions();

}  // namespace piblocks
