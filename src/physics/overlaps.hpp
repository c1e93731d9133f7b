// Bodies that overlap, or are beyond a wall.
// In: a System whose numbers are right. Out: problems that say by how much.
#pragma once

#include <piblocks/system.hpp>

#include "physics/problems.hpp"

namespace piblocks {

/// Touching is allowed. It takes about n log n steps for n bodies.
void check_overlaps(const System& system, SceneProblems& problems);

}  // namespace piblocks
