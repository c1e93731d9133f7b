#include "scene/schedule.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "scene/pacing.hpp"

namespace piblocks {
namespace {

/// Whether the last frame stands at the end; else the video ends before it.
bool shows_end(const Scene& scene) { return !scene.time.to.is_time(); }

/// The speed that gives the video the duration that the scene asks for.
/// @param still_s  of video, before and after the moves.
Rational speed_for_duration(const Scene& scene, const std::vector<Move>& moves, Rational still_s) {
  const Rational& duration_s = *scene.pacing.duration_s;
  Integer frames = ceil(duration_s * scene.view.frame_rate);
  if (scene.pacing.loop && frames < 2) {
    throw UsageError(Problem{
        "time.duration",
        fmt::format("= {}: is shorter than two frames, of which a loop has one forward and one "
                    "back; make it longer",
                    to_text(duration_s))});
  }
  if (scene.pacing.loop) frames = (frames + 1) / 2 + 1;  // see played_back()
  if (shows_end(scene)) frames -= 1;                     // one frame stands at the end
  Rational length = 0;                                   // seconds of video at speed 1
  for (const Move& move : moves) {
    length += (move.to - move.from) * move.slowdown;
    still_s += move.frozen_s;
  }
  const Rational moving_s = Rational(frames) / scene.view.frame_rate - still_s;
  if (moving_s > 0) return length / moving_s;
  if (still_s == 0) {
    throw UsageError(Problem{
        "time.duration",
        fmt::format("= {}: is shorter than two frames; make it longer, or let the video end at a "
                    "time, as --to 10",
                    to_text(duration_s))});
  }
  throw UsageError(Problem{
      "time.duration",
      fmt::format("= {}: leaves no time for the motion, since the picture stands still for {} s; "
                  "make it longer, or --hold-start, --hold-end and --freeze shorter",
                  to_text(duration_s), to_text(still_s))});
}

/// Stretches from the video's start on.
struct StretchList {
  std::vector<Stretch> stretches = {};
  Rational end_s = 0;  ///< of the last stretch

  void add(const Rational& time, const Rational& speed, const Rational& slowdown,
           const Rational& length_s) {
    if (length_s == 0) return;
    stretches.push_back({end_s, time, speed, slowdown});
    end_s += length_s;
  }
  /// Time stands still from here on.
  void stand_still(const Rational& time, const Rational& slowdown) {
    stretches.push_back({end_s, time, 0, slowdown});
  }
};

/// The stretches, and the same backwards. The first and the last frame are shown once only.
std::vector<Stretch> played_back(std::vector<Stretch> stretches, const Rational& last_frame_s) {
  // No frame shows a stretch that begins after the last frame.
  while (stretches.back().video_s > last_frame_s) stretches.pop_back();
  StretchList back{{}, last_frame_s};
  Rational end_s = last_frame_s;
  for (auto stretch = stretches.rbegin(); stretch != stretches.rend(); ++stretch) {
    const Rational length_s = end_s - stretch->video_s;
    back.add(stretch->time + stretch->speed * length_s, -stretch->speed, stretch->slowdown,
             length_s);
    end_s = stretch->video_s;
  }
  // A stretch that begins at the last frame would have no length, since the way back begins there.
  if (stretches.back().video_s == last_frame_s) stretches.pop_back();
  stretches.insert(stretches.end(), back.stretches.begin(), back.stretches.end());
  return stretches;
}

}  // namespace

bool has_span(const Scene& scene, const Log& log) {
  return exists(scene.time.from, log) && exists(scene.time.to, log);
}

Span span_of(const Scene& scene, const Log& log) {
  if (scene.time.to.anchor == Instant::Anchor::last && log.last() == 0) {
    throw UsageError(
        "time.to",
        "no collision happens from time 0 on, so the video cannot end with the last one; "
        "give a time, as time.to = 10");
  }
  return {time_of(scene.time.from, "time.from", log), time_of(scene.time.to, "time.to", log)};
}

Schedule make_schedule(const Scene& scene, const Log& log) {
  const Span span = span_of(scene, log);
  if (span.to <= span.from) {
    throw UsageError(Problem{
        "time.from", fmt::format("= {}: is not before the end at {}; there is nothing to show",
                                 to_text(span.from), to_text(span.to))});
  }
  const Rational& rate = scene.view.frame_rate;
  const Rational hold_start_s = whole_frames(scene.pacing.hold_start_s, rate);
  const Rational hold_end_s = whole_frames(scene.pacing.hold_end_s, rate);
  const std::vector<Move> moves = moves_of(scene, log, span);
  const Rational speed = scene.pacing.duration_s
                             ? speed_for_duration(scene, moves, hold_start_s + hold_end_s)
                             : scene.time.speed;

  StretchList video;
  video.add(span.from, 0, moves.front().slowdown, hold_start_s);
  for (const Move& move : moves) {
    const bool is_frozen = move.frozen_s > 0;
    video.add(move.from, is_frozen ? Rational(0) : Rational(speed / move.slowdown), move.slowdown,
              is_frozen ? move.frozen_s : Rational((move.to - move.from) * move.slowdown / speed));
  }
  // No picture shows a time after the end, even if its shutter is open for longer.
  Integer frame_count = ceil(video.end_s * rate) + ceil(hold_end_s * rate);
  if (shows_end(scene)) frame_count += 1;
  video.stand_still(span.to, moves.back().slowdown);
  if (!scene.pacing.loop || frame_count < 2) {
    return {std::move(video.stretches), frame_count, rate};
  }
  const Rational last_frame_s = Rational(frame_count - 1) / rate;
  return {played_back(std::move(video.stretches), last_frame_s), 2 * frame_count - 2, rate};
}

std::int64_t film_frames(const Schedule& schedule) {
  const Integer& frames = schedule.frame_count();
  if (frames <= to_integer(kMaxFrames)) return frames.get_si();
  throw UsageError("time",
                   fmt::format("{} frames are more than {}; narrow them with --from and --to, or "
                               "raise --speed",
                               readable(frames), readable(to_integer(kMaxFrames))));
}

FrameTime frame_time_alone(const Scene& scene, const Log& log, const Rational& time,
                           const Rational& speed) {
  FrameTime alone{time};
  if (scene.view.shutter == 0) return alone;
  Rational until = time + speed * open_s(scene.view);
  if (has_span(scene, log)) {
    const Rational end = span_of(scene, log).to;
    if (time <= end) until = std::min(until, end);
  }
  alone.exposure = {{time, std::move(until), 1}};
  return alone;
}

Schedule::Schedule(std::vector<Stretch> stretches, Integer frame_count, Rational frame_rate)
    : stretches_(std::move(stretches)),
      frame_count_(std::move(frame_count)),
      frame_rate_(std::move(frame_rate)) {}

Rational Schedule::speed() const {
  const auto moves =
      std::ranges::find_if(stretches_, [](const Stretch& s) { return s.speed != 0; });
  return moves == stretches_.end() ? Rational(0) : Rational(abs(moves->speed) * moves->slowdown);
}

FrameTime Schedule::at(const Rational& video_s, const Rational& open_s) const {
  const auto next = std::ranges::upper_bound(stretches_, video_s, {}, &Stretch::video_s);
  const Stretch& stretch = *std::prev(next);
  FrameTime shown{stretch.time + stretch.speed * (video_s - stretch.video_s), stretch.slowdown};
  if (open_s > 0) shown.exposure = during(video_s, open_s);
  return shown;
}

std::optional<Rational> Schedule::first_shown_s(const Rational& time) const {
  std::optional<Rational> between;  // two frames
  const Rational length_s = Rational(frame_count_) / frame_rate_;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    const Stretch& stretch = stretches_[i];
    const Rational end_s = i + 1 < stretches_.size() ? stretches_[i + 1].video_s : length_s;
    if (stretch.speed == 0 && time != stretch.time) continue;
    Rational video_s = stretch.video_s;
    if (stretch.speed != 0) video_s += (time - stretch.time) / stretch.speed;
    if (video_s < stretch.video_s || video_s >= end_s) continue;
    const Rational frame_s = Rational(ceil(video_s * frame_rate_)) / frame_rate_;
    if (frame_s == video_s || (stretch.speed == 0 && frame_s < end_s)) return frame_s;
    if (!between) between = video_s;
  }
  return between;
}

std::vector<TimeSlice> Schedule::during(const Rational& video_s, const Rational& length_s) const {
  std::vector<TimeSlice> slices;
  const Rational end_s = video_s + length_s;
  auto next = std::ranges::upper_bound(stretches_, video_s, {}, &Stretch::video_s);
  for (Rational now_s = video_s; now_s < end_s;) {
    const Stretch& stretch = *std::prev(next);
    const Rational until_s =
        next == stretches_.end() ? end_s : std::min<Rational>(next->video_s, end_s);
    const auto time = [&](const Rational& s) -> Rational {
      return stretch.time + stretch.speed * (s - stretch.video_s);
    };
    slices.push_back({time(now_s), time(until_s), (until_s - now_s) / length_s});
    now_s = until_s;
    if (next != stretches_.end()) ++next;
  }
  return slices;
}

}  // namespace piblocks
