// Which instant of the run is shown at each moment of the video.
// In: a scene and its collision log. Out: stretches of video in which simulation time runs evenly,
// exactly rational, without gaps. Pictures and sound follow the same ones.
#pragma once

#include <piblocks/collision_log.hpp>
#include <piblocks/scene.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace piblocks {

/// From `video_s` on to the next stretch, simulation time is time + speed * (v - video_s).
struct Stretch {
  Rational video_s;     ///< seconds since the video began
  Rational time;        ///< simulation time at that moment
  Rational speed;       ///< per second of video; 0 while it stands still, negative backwards
  Rational slower = 1;  ///< how many times slower than the scene runs elsewhere
};

/// What a frame shows of time.
struct FrameTime {
  Rational time;
  Rational slower = 1;  ///< as in Stretch
};

/// Simulation time that runs evenly, in either direction or not at all, during a part of an
/// interval of video.
struct TimeSlice {
  Rational from;
  Rational to;
  Rational share;  ///< of that interval
};

/// Where the scene's span of simulation time ends.
/// @throws UsageError if that is after the last collision of a scene without collisions.
Rational end_of(const Scene& scene, const CollisionLog& log);

/// A span that ends at a time T holds the moments before T. A span that ends so long after the last
/// collision goes on to the first frame at or past it, so that the end is seen.
class Schedule {
 public:
  /// @throws UsageError if the span is empty or ends after the last collision of a scene without
  ///         collisions; if windows of slow motion overlap, or name a turn or a last collision that
  ///         is not there; if the duration leaves no time for the motion.
  Schedule(const Scene& scene, const CollisionLog& log);

  /// In the order of the video, the first from 0 s; at least one.
  std::span<const Stretch> stretches() const noexcept { return stretches_; }
  /// Frames of the whole video: all that begin before its end.
  const Integer& frame_count() const noexcept { return frame_count_; }
  /// The instant shown at `video_s` >= 0.
  FrameTime at(const Rational& video_s) const;
  /// The first moment of the video, in seconds, that shows this instant; it may be between frames,
  /// and past the end, where the last stretch goes on.
  std::optional<Rational> first_shown(const Rational& time) const;
  /// What is shown from `video_s` >= 0 on, for a length > 0, in order; shares add up to 1. Past the
  /// end the last stretch goes on.
  std::vector<TimeSlice> during(const Rational& video_s, const Rational& length_s) const;

 private:
  std::vector<Stretch> stretches_;
  Integer frame_count_;
};

}  // namespace piblocks
