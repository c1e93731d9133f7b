// Where the blocks are while the shutter is open.
// In: what passes of time meanwhile. Out: what Composition draws.
#pragma once

#include <piblocks/run.hpp>

#include <span>
#include <vector>

#include "draw/composition.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// Empty if nothing passes, because the scene has no shutter.
std::vector<WeightedExposure> expose(const CollisionLog& log, std::span<const TimeSlice> slices);

}  // namespace piblocks
