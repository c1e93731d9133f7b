// Which instant each frame shows.
// In: a scene, its frame rate, its collision log. Out: frame number -> exact simulation time.
// Nothing is accumulated, so no frame depends on another.
#pragma once

#include <piblocks/schedule.hpp>

#include <cstdint>

namespace piblocks {

/// Most frames of one rendering; four and a half hours at 60 frames per second.
inline constexpr std::int64_t kMaxFrames = 1'000'000;

/// Frame k shows what the schedule shows at k / frame_rate seconds.
class Timeline {
 public:
  /// @throws UsageError as Schedule, or if there are more than kMaxFrames frames.
  Timeline(const Scene& scene, const CollisionLog& log);

  const Schedule& schedule() const noexcept { return schedule_; }
  std::int64_t frame_count() const noexcept { return frame_count_; }
  FrameTime at(std::int64_t frame) const { return schedule_.at(Rational(frame) / frame_rate_); }
  Rational time_of(std::int64_t frame) const { return at(frame).time; }

 private:
  Schedule schedule_;
  Rational frame_rate_;
  std::int64_t frame_count_ = 0;
};

}  // namespace piblocks
