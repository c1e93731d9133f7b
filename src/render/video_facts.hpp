// What a video shows, for its page and for people who cannot see or hear it.
// In: a scene, its collision log, its schedule. Out: one JSON object of frames and collisions, in
// which counts and times that a viewer reads are exact, and what only positions the video is
// rounded to doubles; a title, a description in plain English, captions.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/run_log.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// The page has the times of so many collisions at the beginning, and of as many at the end. It has
/// all of them if there are no more than twice as many.
inline constexpr int kListedAtEachEnd = 2000;

/// Consecutive collisions.
struct CollisionRange {
  Integer first;
  Integer last;  ///< >= first
};

/// Those whose times are given, of the collisions that happen between two counts of frames.
std::vector<CollisionRange> listed_collisions(const Integer& before, const Integer& after);

/// Collisions that a video counts, and those of the whole run.
struct VideoCount {
  Integer at_end;  ///< when the video has come furthest
  Integer total;
  bool is_endless = false;  ///< whether `total` stands for infinitely many
  bool may_go_on = false;   ///< whether `total` is only the count until some time
};

class PageFacts {
 public:
  /// @throws UsageError as film_frames().
  PageFacts(const Scene& scene, const RunLog& run, const Schedule& schedule);

  /// @throws UsageError if the times exceed a browser's numbers. Other outputs can have them.
  void check_range() const;
  /// Collisions that the frames count, at most.
  const Integer& most() const noexcept { return most_; }
  VideoCount count() const;
  /// Number of frames until a loop turns back; of all frames without a loop.
  std::int64_t frames_before_reversal() const noexcept { return frames_before_reversal_; }
  /// Writes the object in pieces. Times are given in units of 10^-scale; of sequences, what each
  /// number adds to the one before, "0~7" being seven times 0. "infinite" is the count that stands
  /// for infinitely many, or null. No "<" is in it.
  void write(const std::function<void(std::string_view)>& sink) const;

 private:
  void write_counts(const std::function<void(std::string_view)>& sink) const;

  const Scene& scene_;
  const Timeline& log_;
  bool is_endless_;  ///< as VideoCount
  const Schedule& schedule_;
  std::int64_t frames_;
  std::int64_t frames_before_reversal_;
  Rational from_;
  Integer first_;
  Integer most_;
};

/// The scene's own title; without one, the masses and the count.
std::string title_of(const Scene& scene, const VideoCount& count);

/// A few sentences: who is there, how they move at first, what the counter says in the end; in
/// which base, if it is not ten; which digits of pi it has counted, if it has counted some.
std::string describe_video(const Scene& scene, const VideoCount& count);

/// Captions give a count exactly if it stands for a second or more, or if it is the highest of the
/// film. Between such counts a caption begins with the first frame that counts 1 collision, 10, 100
/// and so on. It ends where the next one begins. Times are those of frames, rounded up to
/// milliseconds. Before time 0 counts are negative, and captions say how many collisions are to go.
/// @throws UsageError as film_frames().
std::string captions(const Scene& scene, const RunLog& run, const Schedule& schedule);

}  // namespace piblocks
