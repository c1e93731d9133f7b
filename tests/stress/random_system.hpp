// Systems of two blocks as nobody would build them.
// In: a source of random numbers. Out: a valid TwoBlocks.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <string>

#include "support/property.hpp"

namespace piblocks::stress {

/// Masses of 600 decades, equal or nearly equal; lengths and velocities of many decades; blocks at
/// rest, touching, at the wall, running apart, side by side, or into the corner at once. Every
/// velocity that such a system can ever have, and every position for a while, fits a double.
TwoBlocks random_system(Random& random);

/// The same with lengths and velocities from the whole range of a double, the least denormal
/// number included: times and velocities may leave it.
TwoBlocks random_system_of_any_size(Random& random);

/// The numbers of a system in one line.
std::string describe(const TwoBlocks& system);

}  // namespace piblocks::stress
