// Where the blocks are from one instant to another, for motion blur.
// In: a collision log and two times. Out: an Exposure (exposure.hpp).
#pragma once

#include <piblocks/run.hpp>

#include <memory>

#include "physics/exposure.hpp"

namespace piblocks {

/// Where the blocks are from `begin` to `end`, and for how much of that time; in either order,
/// and also before time 0.
/// @throws SimulationError as CollisionLog::at().
std::unique_ptr<Exposure> expose(const CollisionLog& log, const Rational& begin,
                                 const Rational& end);

}  // namespace piblocks
