// What a video's page knows of the run: which instant and which count each frame shows, and when
// collisions happen.
// In: a scene, its collision log, its schedule. Out: one JSON object. Counts and times that a
// viewer reads are exact; what only positions the video is rounded to doubles.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <functional>
#include <string_view>
#include <vector>

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

class PageFacts {
 public:
  /// @throws UsageError as film_frames().
  PageFacts(const Scene& scene, const CollisionLog& log, const Schedule& schedule);

  /// @throws UsageError if the times exceed a browser's numbers. Other outputs can have them.
  void check_range() const;
  /// Collisions that the frames count, at most.
  const Integer& most() const noexcept { return most_; }
  /// Number of frames until a loop turns back; of all frames without a loop.
  std::int64_t frames_before_reversal() const noexcept { return frames_before_reversal_; }
  /// Writes the object in pieces. Times are given in units of 10^-scale; of sequences, what each
  /// number adds to the one before, "0~7" being seven times 0. No "<" is in it.
  void write(const std::function<void(std::string_view)>& sink) const;

 private:
  void write_counts(const std::function<void(std::string_view)>& sink) const;

  const Scene& scene_;
  const CollisionLog& log_;
  const Schedule& schedule_;
  std::int64_t frames_;
  std::int64_t frames_before_reversal_;
  Rational from_;
  Integer first_;
  Integer most_;
};

}  // namespace piblocks
