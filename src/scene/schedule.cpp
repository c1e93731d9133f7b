#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/schedule.hpp>

#include <algorithm>
#include <utility>

#include "scene/slow_motion.hpp"

namespace piblocks {
namespace {

/// A freeze as an instant and whole frames of video.
struct Stop {
  Rational time;
  Rational length_s;
};

/// The motion from its beginning to its end, before it is known how fast it runs.
struct Motions {
  Rational from;
  Rational to;
  std::vector<SlowWindow> slow;  ///< in order, apart
  std::vector<Stop> stops;       ///< in order

  /// Seconds of video at speed 1, without the stops.
  Rational length() const {
    Rational sum = to - from;
    for (const SlowWindow& window : slow) sum += (window.to - window.from) * (window.factor - 1);
    return sum;
  }
  Rational stopped_s() const {
    Rational sum = 0;
    for (const Stop& stop : stops) sum += stop.length_s;
    return sum;
  }
};

class ScheduleBuilder {
 public:
  ScheduleBuilder(const Scene& scene, const CollisionLog& log);
  void build();
  std::vector<Stretch> take_stretches() { return std::move(stretches_); }
  const Integer& frame_count() const noexcept { return frame_count_; }

 private:
  Rational whole_frames(const Rational& length_s) const {
    return Rational(ceil(length_s * rate_)) / rate_;
  }
  Rational speed() const;
  void run_to(const Rational& time, const Rational& slower);
  void run_past_stops(const Rational& time, const Rational& slower);
  void stand(const Rational& length_s);
  void append(Stretch stretch);
  void play_back();

  std::vector<Stretch> stretches_;
  Integer frame_count_;
  const Pacing& pacing_;
  Rational rate_;
  bool after_last_;
  Rational given_speed_;
  Rational hold_start_s_;
  Rational hold_end_s_;
  Motions motions_;
  Rational speed_;

  Rational video_s_ = 0;
  Rational time_;
  std::size_t next_stop_ = 0;
};

ScheduleBuilder::ScheduleBuilder(const Scene& scene, const CollisionLog& log)
    : pacing_(scene.pacing),
      rate_(scene.view.frame_rate),
      after_last_(scene.time.to.after_last),
      given_speed_(scene.time.speed),
      hold_start_s_(whole_frames(pacing_.hold_start_s)),
      hold_end_s_(whole_frames(pacing_.hold_end_s)),
      motions_{scene.time.from, end_of(scene, log), {}, {}},
      time_(motions_.from) {
  if (motions_.to <= motions_.from) {
    throw UsageError(
        fmt::format("time.from = {}: is not before the end at {}; there is nothing to show",
                    to_text(motions_.from), to_text(motions_.to)));
  }
  motions_.slow = slow_windows(scene, log, motions_.from, motions_.to);
  for (const Freeze& freeze : pacing_.freezes) {
    const Rational time = time_of(freeze.at, "time.freeze", scene, log);
    if (time < motions_.from || time > motions_.to) continue;
    motions_.stops.push_back({time, whole_frames(freeze.length_s)});
  }
  std::ranges::stable_sort(motions_.stops, {}, &Stop::time);
}

/// Of the scene, or such that the video takes as long as it is to take.
Rational ScheduleBuilder::speed() const {
  if (!pacing_.duration_s) return given_speed_;
  Integer frames = ceil(*pacing_.duration_s * rate_);
  if (pacing_.loop) frames = (frames + 1) / 2 + 1;  // see play_back()
  // At the end of a run that is shown to its end one frame stands at that end.
  if (after_last_) frames -= 1;
  const Rational standing_s = hold_start_s_ + hold_end_s_ + motions_.stopped_s();
  const Rational moving_s = Rational(frames) / rate_ - standing_s;
  if (moving_s > 0) return motions_.length() / moving_s;
  if (standing_s == 0) {
    throw UsageError(fmt::format(
        "time.duration = {}: is shorter than two frames; make it longer, or let the video end at a "
        "time, as --to 10",
        to_text(*pacing_.duration_s)));
  }
  throw UsageError(fmt::format(
      "time.duration = {}: leaves no time for the motion, since the picture stands still for {} s; "
      "make it longer, or --hold-start, --hold-end and --freeze shorter",
      to_text(*pacing_.duration_s), to_text(standing_s)));
}

void ScheduleBuilder::append(Stretch stretch) {
  // What begins when the next does takes no time.
  if (!stretches_.empty() && stretches_.back().video_s == stretch.video_s) stretches_.pop_back();
  stretches_.push_back(std::move(stretch));
}

void ScheduleBuilder::run_to(const Rational& time, const Rational& slower) {
  if (time <= time_) return;
  append({video_s_, time_, speed_ / slower, slower});
  video_s_ += (time - time_) * slower / speed_;
  time_ = time;
}

void ScheduleBuilder::run_past_stops(const Rational& time, const Rational& slower) {
  const auto& stops = motions_.stops;
  for (; next_stop_ < stops.size() && stops[next_stop_].time < time; ++next_stop_) {
    run_to(stops[next_stop_].time, slower);
    append({video_s_, time_, 0, slower});
    video_s_ += stops[next_stop_].length_s;
  }
  run_to(time, slower);
}

void ScheduleBuilder::stand(const Rational& length_s) {
  if (length_s == 0) return;
  append({video_s_, time_, 0, 1});
  video_s_ += length_s;
}

/// The same again from the last frame to the first, neither of which is repeated.
void ScheduleBuilder::play_back() {
  if (frame_count_ < 2) return;
  const Rational turn_s = Rational(frame_count_ - 1) / rate_;
  // What begins after the last frame is shown by none.
  while (stretches_.back().video_s > turn_s) stretches_.pop_back();
  const auto forth = static_cast<std::ptrdiff_t>(stretches_.size());
  Rational end_s = turn_s;
  for (std::ptrdiff_t i = forth - 1; i >= 0; --i) {
    const Stretch stretch = stretches_[static_cast<std::size_t>(i)];
    if (stretch.video_s >= end_s) continue;
    append({2 * turn_s - end_s, stretch.time + stretch.speed * (end_s - stretch.video_s),
            -stretch.speed, stretch.slower});
    end_s = stretch.video_s;
  }
  frame_count_ = 2 * frame_count_ - 2;
}

void ScheduleBuilder::build() {
  speed_ = speed();
  stand(hold_start_s_);
  for (const SlowWindow& window : motions_.slow) {
    run_past_stops(window.from, 1);
    run_past_stops(window.to, window.factor);
  }
  run_past_stops(motions_.to, 1);
  const auto& stops = motions_.stops;
  for (; next_stop_ < stops.size(); ++next_stop_) stand(stops[next_stop_].length_s);

  frame_count_ = ceil(video_s_ * rate_);
  if (after_last_) {
    // The motion goes on to the next frame, which may stand still then.
    frame_count_ += 1;
    const Rational last_s = Rational(frame_count_ - 1) / rate_;
    const Stretch& last = stretches_.back();
    time_ = last.time + last.speed * (last_s - last.video_s);
    video_s_ = last_s;
  }
  stand(hold_end_s_);
  frame_count_ += ceil(hold_end_s_ * rate_);
  if (pacing_.loop) play_back();
}

}  // namespace

Rational end_of(const Scene& scene, const CollisionLog& log) {
  const End& end = scene.time.to;
  if (!end.after_last) return end.offset;
  if (log.size() == 0) {
    throw UsageError(
        "time.to: the scene has no collision to end after; give a time, such as to = 10 in [time]");
  }
  return to_rational(log.at(log.size()).time) + end.offset;
}

Schedule::Schedule(const Scene& scene, const CollisionLog& log) {
  ScheduleBuilder builder(scene, log);
  builder.build();
  stretches_ = builder.take_stretches();
  frame_count_ = builder.frame_count();
}

std::optional<Rational> Schedule::first_shown(const Rational& time) const {
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    const Stretch& stretch = stretches_[i];
    if (time == stretch.time) return stretch.video_s;
    if (stretch.speed == 0) continue;
    const Rational video_s = stretch.video_s + (time - stretch.time) / stretch.speed;
    const bool is_over = i + 1 < stretches_.size() && video_s >= stretches_[i + 1].video_s;
    if (video_s > stretch.video_s && !is_over) return video_s;
  }
  return std::nullopt;
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

FrameTime Schedule::at(const Rational& video_s) const {
  const auto next = std::ranges::upper_bound(stretches_, video_s, {}, &Stretch::video_s);
  const Stretch& stretch = *std::prev(next);
  return {stretch.time + stretch.speed * (video_s - stretch.video_s), stretch.slower};
}

}  // namespace piblocks
