// Which instant of the run the video shows at each of its times.
// In: a scene and its collision log. Out: exact stretches of video without gaps, in each of which
// simulation time runs evenly. Pictures and sound follow the same stretches.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace piblocks {

/// Most frames of one rendering; four and a half hours at 60 frames per second.
inline constexpr std::int64_t kMaxFrames = 1'000'000;

/// At v seconds of video, from `video_s` to the next stretch, simulation time is
/// time + speed * (v - video_s).
struct Stretch {
  Rational video_s;       ///< seconds since the video began
  Rational time;          ///< simulation time then
  Rational speed;         ///< per second of video; 0 while it stands still, negative backwards
  Rational slowdown = 1;  ///< how many times slower than the scene runs elsewhere
};

/// Simulation time that runs evenly, in either direction or not at all, during a share of an
/// interval of video.
struct TimeSlice {
  Rational from;
  Rational to;
  Rational share;
};

/// The time that a picture shows.
struct FrameTime {
  Rational time;
  Rational slowdown = 1;  ///< as in Stretch
  /// The times while the shutter is open, in order; empty without a shutter.
  std::vector<TimeSlice> exposure = {};
};

/// An interval of simulation time.
struct Span {
  Rational from;
  Rational to;
};

/// Whether the run has the instants between which the scene is shown.
bool has_span(const Scene& scene, const Log& log);

/// The times between which the scene is shown.
/// @throws UsageError unless has_span().
Span span_of(const Scene& scene, const Log& log);

/// Frame k shows what the video shows at k / frame_rate seconds. Nothing is accumulated, so no
/// frame depends on another.
class Schedule {
 public:
  /// @param stretches  in the order of the video, the first from 0 s; at least one.
  Schedule(std::vector<Stretch> stretches, Integer frame_count, Rational frame_rate);

  std::span<const Stretch> stretches() const noexcept { return stretches_; }
  /// Frames of the whole video: all that begin before its end.
  const Integer& frame_count() const noexcept { return frame_count_; }

  /// Simulation time per second of video where nothing slows it down; 0 if the picture never moves.
  Rational speed() const;

  /// The nearest time at which there is a frame, or which is between frames.
  Rational within(const Rational& video_s) const {
    const Rational last_s = Rational(frame_count_ - 1) / frame_rate_;
    return std::clamp<Rational>(video_s, 0, std::max<Rational>(last_s, 0));
  }
  /// What is shown at `video_s` >= 0, and while a shutter is open from then on, `open_s` long. Past
  /// the end the last stretch goes on.
  FrameTime at(const Rational& video_s, const Rational& open_s = 0) const;
  /// What a frame shows. @param number  >= 0
  FrameTime frame(std::int64_t number, const Rational& open_s = 0) const {
    return at(Rational(to_integer(number)) / frame_rate_, open_s);
  }
  /// Simulation time of a frame.
  Rational time_of(std::int64_t number) const { return frame(number).time; }
  /// When the video first shows this time, in seconds of video: at the first frame that shows it,
  /// or, if no frame does, where the video first passes it between two frames. Nothing if it never
  /// does.
  std::optional<Rational> first_shown_s(const Rational& time) const;
  /// The times shown from `video_s` >= 0 on, for a length > 0, in order; shares add up to 1. Past
  /// the end the last stretch goes on.
  std::vector<TimeSlice> during(const Rational& video_s, const Rational& length_s) const;

 private:
  std::vector<Stretch> stretches_;
  Integer frame_count_;
  Rational frame_rate_;
};

/// No frame shows a time after scene.time.to: there the picture stands. If this end is a time, the
/// video ends before it, unless the end is held. If a turn or a collision names it, one more frame
/// shows it.
/// @throws UsageError as span_of(); if the span is empty; if windows of slow motion overlap; if a
///         window or a freeze is outside of the span; if the duration leaves no time for the
///         motion.
Schedule make_schedule(const Scene& scene, const Log& log);

/// The number of frames of a film.
/// @throws UsageError if they are more than kMaxFrames.
std::int64_t film_frames(const Schedule& schedule);

/// Whether some of the video may be slower than the rest, which a label then says.
inline bool has_slow_motion(const Pacing& pacing) {
  return pacing.automatic_slow_motion || !pacing.slow_motion.empty();
}

/// How long each frame is exposed, in seconds of video.
inline Rational open_s(const View& view) { return view.shutter / view.frame_rate; }

/// What a picture shows if no video shows its time: time runs at this speed, and stops at the
/// scene's end.
FrameTime frame_time_alone(const Scene& scene, const Log& log, const Rational& time,
                           const Rational& speed);

}  // namespace piblocks
