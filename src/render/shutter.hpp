// For how long a picture is exposed, and where the blocks are in the meantime.
// In: a scene and a frame or an instant. Out: what Composition draws.
#pragma once

#include <piblocks/collision_log.hpp>
#include <piblocks/composition.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/schedule.hpp>

#include <cstdint>
#include <vector>

namespace piblocks {

/// From a frame's instant on, for scene.view.shutter of the time to the next frame; nothing if that
/// is 0.
std::vector<ExposurePart> expose_frame(const Scene& scene, const CollisionLog& log,
                                       const Schedule& schedule, std::int64_t frame);

/// The same of a still: what a frame would have that begins when the video first shows `time`.
/// Where the video does not show it, time runs at scene.time.speed.
/// @throws UsageError as Schedule.
std::vector<ExposurePart> expose_still(const Scene& scene, const CollisionLog& log,
                                       const Rational& time);

}  // namespace piblocks
