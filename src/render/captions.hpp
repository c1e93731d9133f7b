// How far the count is, for those who read along.
// In: the count of every frame. Out: captions in WebVTT.
#pragma once

#include <piblocks/collision_log.hpp>
#include <piblocks/schedule.hpp>

#include <string>

namespace piblocks {

/// A caption from the first frame on that shows a first collision, ten, a hundred and so on, and
/// the most there are in the video; each until the next one. Times are those of frames, rounded up
/// to milliseconds. Before time 0, where counts are negative, captions say how many collisions are
/// to go until then.
/// @throws UsageError as film_frames().
std::string captions(const CollisionLog& log, const Schedule& schedule, const Rational& frame_rate);

}  // namespace piblocks
