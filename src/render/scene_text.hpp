// A video in words, for people who cannot see it.
// In: a scene, and how far its video goes. Out: sentences in plain English, and a title.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/scene.hpp>

#include <string>

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

}  // namespace piblocks
