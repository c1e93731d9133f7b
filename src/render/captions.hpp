// How far the count is, for viewers who read captions.
// In: the count of every frame. Out: captions in WebVTT.
#pragma once

#include <piblocks/run.hpp>

#include <string>

#include "scene/schedule.hpp"

namespace piblocks {

/// A caption begins with the first frame that counts 1 collision, 10, 100 and so on, and with the
/// first that counts as many as any frame does. It ends where the next one begins. Times are those
/// of frames, rounded up to milliseconds. Before time 0 counts are negative, and captions say how
/// many collisions are to go until then.
/// @throws UsageError as film_frames().
std::string captions(const CollisionLog& log, const Schedule& schedule, const Rational& frame_rate);

}  // namespace piblocks
