#include "render/film.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "core/smooth_step.hpp"
#include "core/stop.hpp"
#include "draw/montage.hpp"
#include "media/png/png_reader.hpp"
#include "physics/problems.hpp"
#include "scene/pacing.hpp"
#include "sound/run_sound.hpp"

namespace piblocks {
namespace {

/// The place of the run whose last collision comes last; the first of several.
std::size_t longest(const std::vector<std::unique_ptr<Log>>& logs) {
  std::size_t found = 0;
  std::optional<Rational> latest;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const Log& log = *logs[i];
    if (!exists(Instant::last(), log)) continue;
    Rational last = time_of(Instant::last(), log);
    if (latest && last <= *latest) continue;
    latest = std::move(last);
    found = i;
  }
  return found;
}

std::string place_of(const Storyboard& story, std::size_t segment) {
  const std::string& origin = story.segments[segment].origin;
  return origin.empty() ? fmt::format("part {}", segment + 1) : origin;
}

/// What a card shows in each of its frames.
std::function<DrawList(std::int64_t)> card_frames(const Card& card, const View& film) {
  if (card.becomes.empty()) {
    return [picture = compose_card(card.lines, film)](std::int64_t /*number*/) { return picture; };
  }
  constexpr double kLength_s = 0.6;
  const double rate = to_double(film.frame_rate);
  const double from_s = to_double(kCardChanges * card.length_s);
  return [=, picture = ChangingCard(card.lines, card.becomes, film)](std::int64_t number) {
    const double passed = (double(number) / rate - from_s) / kLength_s;
    return picture.picture(smooth_step(std::clamp(passed, 0.0, 1.0)));
  };
}

/// The volume of both segments of a fade. It follows the opacity of their pictures.
struct FadeRamps {
  std::optional<Ramp> fall;  ///< of the segment before
  std::optional<Ramp> rise;  ///< of the segment itself
};

/// So many samples as there is room for, of so many pairs.
std::size_t room(std::span<const float> samples, std::int64_t pairs) {
  return 2 * std::min(samples.size() / 2, static_cast<std::size_t>(pairs));
}

/// From one frame before the fade, where only the segment before is seen, to the first one after
/// it, where only the new one is. Half-way both are silent.
FadeRamps ramps_of(const PlacedSegment& segment, const Rational& frame_rate) {
  if (segment.fade_frames == 0) return {};
  const Rational begin_s = Rational(to_integer(segment.first_frame - 1)) / frame_rate;
  const Rational end_s =
      Rational(to_integer(segment.first_frame + segment.fade_frames)) / frame_rate;
  const Rational middle_s = (begin_s + end_s) / 2;
  return {Ramp{begin_s, middle_s}, Ramp{middle_s, end_s}};
}

std::vector<Voice> voices_of(const Film& film) {
  const Rational& rate = film.view().frame_rate;
  std::vector<Voice> voices;
  for (std::size_t i = 0; i < film.segments().size(); ++i) {
    const PlacedSegment& placed = film.segments()[i];
    const FilmSegment& segment = placed.segment;
    for (std::size_t k = 0; k < segment.runs().size(); ++k) {
      const FilmRun& run = segment.runs()[k];
      const auto stretches = segment.schedule()->stretches();
      Voice& voice = voices.emplace_back(
          Voice{.scene = run.scene(),
                .log = run.log(),
                .stretches = {stretches.begin(), stretches.end()},
                .begin_s = Rational(to_integer(placed.first_frame)) / rate,
                .end_s = Rational(to_integer(placed.first_frame + segment.frame_count())) / rate});
      voice.rise = ramps_of(placed, rate).rise;
      if (i + 1 < film.segments().size()) voice.fall = ramps_of(film.segments()[i + 1], rate).fall;
      const PixelRect cell = segment.cell(k);
      voice.left = double(cell.x_px) / film.view().width_px;
      voice.right = double(cell.right_px()) / film.view().width_px;
    }
  }
  return voices;
}

/// The latest time that a picture shows, including its exposure.
Rational last_time(const FrameTime& shown) {
  Rational last = shown.time;
  for (const TimeSlice& slice : shown.exposure) last = std::max({last, slice.from, slice.to});
  return last;
}

}  // namespace

FilmRun::FilmRun(Scene scene, std::unique_ptr<const Log> log, FilmUse use)
    : scene_(std::move(scene)), log_(std::move(log)) {
  if (use == FilmUse::audio_only) return;
  composition_.emplace(scene_, *log_, read_logo(scene_));
}

DrawList FilmRun::picture(const FrameTime& shown, const Rational& speed,
                          const std::optional<VideoTime>& video_time) const {
  require_certain(scene_, *log_, last_time(shown));
  return composition_->frame(frame_state(*log_, shown, composition_->needs(), speed, video_time));
}

DrawList FilmRun::picture_at(const Schedule& schedule, const Rational& video_s) const {
  return picture(schedule.at(video_s, open_s(scene_.view)), schedule.speed(),
                 VideoTime{schedule, video_s});
}

DrawList FilmRun::frame(const Schedule& schedule, std::int64_t number) const {
  return picture_at(schedule, Rational(to_integer(number)) / scene_.view.frame_rate);
}

std::vector<DrawList> FilmRun::stills(std::span<const Rational> times,
                                      const std::function<void()>& on_picture) const {
  const FrameNeeds& needs = composition_->needs();
  const bool depends_on_video = needs.hits || needs.video_s || needs.trail_s > 0 ||
                                scene_.view.shutter > 0 || has_slow_motion(scene_.pacing);
  std::optional<Schedule> schedule;
  if (depends_on_video && has_span(scene_, log())) {
    schedule = make_schedule(scene_, log());
  }
  const Rational speed = schedule ? schedule->speed() : nominal_speed(scene_);
  std::vector<DrawList> pictures;
  for (const Rational& time : times) {
    const auto video_s = schedule ? schedule->first_shown_s(time) : std::nullopt;
    pictures.push_back(
        video_s ? picture_at(*schedule, *video_s)
                : picture(frame_time_alone(scene_, log(), time, speed), speed, std::nullopt));
    on_picture();
  }
  return pictures;
}

DrawList FilmRun::still(const Instant& instant) const {
  const Rational time = time_of(instant, log());
  return std::move(stills({&time, 1}, [] {}).front());
}

FilmRun run_of(const Scene& scene, const std::stop_token& stop) {
  require_valid(problems_of(scene));
  return {scene, log_of(scene, stop), FilmUse::pictures};
}

std::shared_ptr<const Image> read_logo(const Scene& scene) {
  if (scene.show.logo.empty()) return nullptr;
  return std::make_shared<const Image>(read_png(scene.show.logo));
}

FilmSegment::FilmSegment(const Segment& segment, const View& film, const FilmMaking& making) {
  const auto* const scenes = std::get_if<Scenes>(&segment.content);
  if (scenes == nullptr) {
    card_ = std::get<Card>(segment.content);
    show_card(film, making);
  } else if (scenes->size() == 1) {
    show_one(with_film_view(scenes->front(), film), making);
  } else {
    compare(*scenes, segment.split, film, making);
  }
}

void FilmSegment::show_card(const View& film, const FilmMaking& making) {
  const Integer frames = ceil(card_.length_s * film.frame_rate);
  if (frames > to_integer(kMaxFrames)) {
    throw UsageError(
        Problem{"seconds", fmt::format("= {}: {} frames are more than {}", to_text(card_.length_s),
                                       readable(frames), readable(to_integer(kMaxFrames)))});
  }
  frame_count_ = frames.get_si();
  if (making.use == FilmUse::pictures) card_frame_ = card_frames(card_, film);
}

void FilmSegment::show_one(Scene scene, const FilmMaking& making) {
  std::unique_ptr<Log> log = log_of(scene, making.stop);
  schedule_ = make_schedule(scene, *log);
  frame_count_ = film_frames(*schedule_);
  runs_.emplace_back(std::move(scene), std::move(log), making.use);
}

void FilmSegment::compare(const Scenes& scenes, Split split, const View& film,
                          const FilmMaking& making) {
  split_.emplace(film, scenes.size(), split);
  std::vector<std::unique_ptr<Log>> logs;
  for (const Scene& scene : scenes) logs.push_back(log_of(scene, making.stop));
  const std::size_t leader = longest(logs);
  const Scene leading = with_film_view(scenes[leader], film);
  schedule_ = make_schedule(leading, *logs[leader]);
  frame_count_ = film_frames(*schedule_);
  const Span span = span_of(leading, *logs[leader]);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    Scene scene = with_film_view(scenes[i], film);
    scene.view.width_px = split_->cells()[i].width_px;
    scene.view.height_px = split_->cells()[i].height_px;
    if (split_->is_in_rows()) scene.view.short_side_px = std::min(film.width_px, film.height_px);
    scene.time.from = span.from;
    scene.time.to = span.to;
    scene.time.speed = leading.time.speed;
    scene.pacing = leading.pacing;
    runs_.emplace_back(std::move(scene), std::move(logs[i]), making.use);
  }
}

PixelRect FilmSegment::cell(std::size_t run) const {
  if (split_) return split_->cells()[run];
  const View& view = runs_[run].scene().view;
  return {0, 0, view.width_px, view.height_px};
}

DrawList FilmSegment::frame(std::int64_t number) const {
  if (runs_.empty()) return card_frame_(number);
  if (!split_) return runs_.front().frame(*schedule_, number);
  std::vector<DrawList> pictures;
  pictures.reserve(runs_.size());
  for (const FilmRun& run : runs_) pictures.push_back(run.frame(*schedule_, number));
  return split_->compose(std::move(pictures));
}

std::int64_t FilmSegment::furthest_frame() const {
  // A loop shows its first frame and the one at which it turns back once.
  const bool is_loop = !runs_.empty() && runs_.front().scene().pacing.loop;
  return is_loop ? frame_count_ / 2 : frame_count_ - 1;
}

void FilmSegment::require_certain(const FrameRange& frames, bool with_sound) const {
  for (const FilmRun& run : runs_) {
    const View& view = run.scene().view;
    const std::int64_t furthest =
        std::clamp(furthest_frame(), with_sound ? 0 : frames.first, frames.last);
    const FrameTime shown =
        schedule_->frame(furthest, with_sound ? Rational(1 / view.frame_rate) : open_s(view));
    piblocks::require_certain(run.scene(), run.log(), last_time(shown));
  }
}

Film::Film(const Script& script, const FilmMaking& making) : view_(view_of(script)) {
  if (const auto* scene = std::get_if<Scene>(&script)) {
    require_valid(problems_of(*scene));
    is_scene_ = true;
    segments_.push_back({FilmSegment({.content = Scenes{*scene}}, view_, making)});
    frame_count_ = segments_.front().segment.frame_count();
    return;
  }
  const auto& story = std::get<Storyboard>(script);
  require_valid(problems_of(story));
  add_segments(story, making);
  place_segments(story);
}

void Film::add_segments(const Storyboard& story, const FilmMaking& making) {
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < story.segments.size(); ++i) {
    try {
      segments_.push_back({FilmSegment(story.segments[i], view_, making)});
    } catch (const UsageError& error) {
      for (Problem problem : error.problems()) {
        problem.origin = place_of(story, i) + (problem.origin.empty() ? "" : ": ") + problem.origin;
        problems.push_back(std::move(problem));
      }
    }
  }
  if (!problems.empty()) throw UsageError(std::move(problems));
}

void Film::place_segments(const Storyboard& story) {
  std::vector<Problem> problems;
  std::int64_t before = 0;  // frames of the segment before that do not belong to its own fade
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    PlacedSegment& placed = segments_[i];
    const std::int64_t own = placed.segment.frame_count();
    const Rational& fade_s = story.segments[i].fade_s;
    const Integer fade = floor(fade_s * view_.frame_rate + Rational(1, 2));
    const std::int64_t room = i == 0 ? 0 : std::min(before, own - 1);
    if (fade > to_integer(room)) {
      problems.push_back(Problem{
          .key = "fade",
          .reason = fmt::format(
              "= {}: must take at most {} frames, not {}: a fade must be shorter than "
              "its own part and the part before, and must not overlap the fade of the part before",
              to_text(fade_s), room, readable(fade)),
          .origin = place_of(story, i)});
    } else {
      placed.fade_frames = fade.get_si();
    }
    placed.first_frame = frame_count_ - placed.fade_frames;
    frame_count_ = placed.first_frame + own;
    before = own - std::max<std::int64_t>(placed.fade_frames, 1);
  }
  if (!problems.empty()) throw UsageError(std::move(problems));
  if (frame_count_ <= kMaxFrames) return;
  throw UsageError(fmt::format("storyboard: {} frames are more than {}; make its parts shorter",
                               readable(to_integer(frame_count_)),
                               readable(to_integer(kMaxFrames))));
}

FrameRange Film::shot(std::size_t segment) const {
  const bool is_last = segment + 1 == segments_.size();
  return {segments_[segment].first_frame,
          (is_last ? frame_count_ : segments_[segment + 1].first_frame) - 1};
}

DrawList Film::frame(std::int64_t number) const {
  const auto next = std::ranges::upper_bound(segments_, number, {}, &PlacedSegment::first_frame);
  const PlacedSegment& placed = *std::prev(next);
  const std::int64_t in_segment = number - placed.first_frame;
  if (in_segment >= placed.fade_frames) return placed.segment.frame(in_segment);
  // From the last frame before the fade to the first one after it. Half-way only the background is
  // seen.
  const std::int64_t steps = placed.fade_frames + 1;
  const std::int64_t to_middle = steps - 2 * (in_segment + 1);  // in half steps; < 0 past it
  const double opacity = double(std::abs(to_middle)) / double(steps);
  if (number >= placed.first_seen()) return faded(placed.segment.frame(in_segment), opacity);
  const PlacedSegment& before = *std::prev(next, 2);
  return faded(before.segment.frame(number - before.first_frame), opacity);
}

void Film::require_certain(const FrameRange& frames, bool with_sound) const {
  for (const auto& [segment, first_frame, fade] : segments_) {
    const FrameRange own{std::max<std::int64_t>(frames.first - first_frame, 0),
                         std::min(frames.last - first_frame, segment.frame_count() - 1)};
    if (own.first <= own.last) segment.require_certain(own, with_sound);
  }
}

std::int64_t frame_at(const Film& film, const Instant& instant) {
  if (!instant.is_time() && instant.anchor != Instant::Anchor::last) {
    throw UsageError(fmt::format(
        "'{}' is an instant of one run; of a storyboard, name a second of the video, or 'last' for "
        "its last frame",
        exact_text(instant)));
  }
  const Rational& rate = film.view().frame_rate;
  const Rational anchor_s =
      instant.is_time() ? Rational(0) : Rational(to_integer(film.frame_count() - 1)) / rate;
  const Integer frame = floor((anchor_s + instant.offset) * rate);
  if (frame >= 0 && frame < to_integer(film.frame_count())) return frame.get_si();
  throw UsageError(fmt::format("{}: the storyboard's video lasts from 0 to {} s",
                               exact_text(instant),
                               to_text(Rational(to_integer(film.frame_count())) / rate)));
}

FilmSound::FilmSound(const Film& film, const FrameRange& frames, std::stop_token stop,
                     std::function<void(std::int64_t)> on_samples)
    : film_(film),
      soundtrack_(voices_of(film),
                  Rational(to_integer(film.frame_count())) / film.view().frame_rate),
      stop_(std::move(stop)),
      on_samples_(std::move(on_samples)) {
  begin(frames);
}

void FilmSound::begin(const FrameRange& frames) {
  first_ = samples_before(frames.first, film_.view().frame_rate);
  end_ = samples_before(frames.last + 1, film_.view().frame_rate);
  is_cut_ = frames.last < film_.frames().last;
}

std::size_t FilmSound::read(std::span<float> samples) {
  // The level of each sample depends on those before it.
  for (check_stop(stop_); next_ < first_; check_stop(stop_)) {
    next_ += std::int64_t(soundtrack_.read(samples.first(room(samples, first_ - next_))));
  }
  const std::size_t count = soundtrack_.read(samples.first(room(samples, end_ - next_)));
  for (std::size_t i = 0; is_cut_ && i < count; ++i) {
    const auto weight = float(weight_before_cut(double(end_ - next_ - std::int64_t(i))));
    samples[2 * i] *= weight;
    samples[2 * i + 1] *= weight;
  }
  next_ += static_cast<std::int64_t>(count);
  on_samples_(next_ - first_);
  return count;
}

}  // namespace piblocks
