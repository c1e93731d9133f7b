// A video in words, for people who cannot see or hear it.
// In: a scene, its log and its schedule. Out: a title, a description in plain English, captions.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <string>

#include "scene/schedule.hpp"

namespace piblocks {

/// Collisions that a video counts, and those of the whole run.
struct VideoCount {
  Integer at_end;  ///< when the video has come furthest
  Integer total;
};

/// The scene's own title; without one, the masses and the count.
std::string title_of(const Scene& scene, const VideoCount& count);

/// Three sentences: who is there, how they move at first, what the counter says in the end.
std::string describe_video(const Scene& scene, const VideoCount& count);

/// A caption begins with the first frame that counts 1 collision, 10, 100 and so on, and with the
/// first that counts as many as any frame does. It ends where the next one begins. Times are those
/// of frames, rounded up to milliseconds. Before time 0 counts are negative, and captions say how
/// many collisions are to go until then.
/// @throws UsageError as film_frames().
std::string captions(const CollisionLog& log, const Schedule& schedule, const Rational& frame_rate);

}  // namespace piblocks
