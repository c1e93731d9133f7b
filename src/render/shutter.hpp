// Where the blocks are while the shutter is open.
// In: what passes of time meanwhile. Out: what Composition draws.
#pragma once

#include <piblocks/collision_log.hpp>
#include <piblocks/composition.hpp>
#include <piblocks/schedule.hpp>

#include <span>
#include <vector>

namespace piblocks {

/// Empty if nothing passes, because the scene has no shutter.
std::vector<WeightedExposure> expose(const CollisionLog& log, std::span<const TimeSlice> slices);

}  // namespace piblocks
