// Which instant each frame shows.
// In: a scene's span of time, its frame rate, its collision log. Out: frame number -> exact
// simulation time. Nothing is accumulated, so no frame depends on another.
#pragma once

#include <piblocks/collision_log.hpp>
#include <piblocks/scene.hpp>

#include <cstdint>

namespace piblocks {

/// Most frames of one rendering; four and a half hours at 60 frames per second.
inline constexpr std::int64_t kMaxFrames = 1'000'000;

/// Frame k shows the instant from + k * speed / frame_rate.
/// A span that ends at a time T holds the frames before T: it lasts (T - from) / speed seconds.
/// A span that ends so long after the last collision goes on to the first frame at or past it,
/// so that the end is seen.
class Timeline {
 public:
  /// @throws UsageError if the span is empty, has more than kMaxFrames frames, or ends after
  ///         the last collision of a scene without collisions.
  Timeline(const Scene& scene, const CollisionLog& log);

  std::int64_t frame_count() const noexcept { return frame_count_; }
  Rational time_of(std::int64_t frame) const { return from_ + step_ * Rational(frame); }

 private:
  Rational from_;
  Rational step_;
  std::int64_t frame_count_ = 0;
};

}  // namespace piblocks
