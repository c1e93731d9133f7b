// What a video shows, in words: for its page, and for people who cannot see or hear it.
// In: a scene, its log, its schedule. Out: a title, a description in plain English, captions.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>

#include "scene/run_log.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// Collisions that a video counts, and those of the whole run.
struct VideoCount {
  Integer at_end;                     ///< when the video has come furthest
  std::optional<Integer> total = {};  ///< of two blocks, and of all that the video shows to the end
  bool is_endless = false;            ///< whether `total` stands for infinitely many
};

/// @throws UsageError as film_frames().
VideoCount video_count(const Scene& scene, const Log& log, const Schedule& schedule);

/// Number of frames until a loop turns back; of all frames without a loop.
/// @throws UsageError as film_frames().
std::int64_t frames_before_reversal(const Scene& scene, const Schedule& schedule);

/// The scene's own title; without one, the masses and the count.
std::string title_of(const Scene& scene, const Log& log, const VideoCount& count);

/// A few sentences: who is there, how they move at first, what the counter says in the end; in
/// which base, if it is not ten; which digits of pi it has counted, if it has counted some.
std::string describe_video(const Scene& scene, const Log& log, const VideoCount& count);

/// WebVTT. A caption gives the exact count if that stays for a second or more, or is the film's
/// highest. Other captions say "100 collisions or more", from the first frame that counts 1, 10,
/// 100 and so on. A caption ends where the next one begins. Times are those of frames, rounded up
/// to milliseconds. Before time 0 captions give the number of collisions until time 0.
/// @throws UsageError as film_frames().
std::string captions(const Scene& scene, const Log& log, const Schedule& schedule);

}  // namespace piblocks
