#include "render/film_part.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <utility>

#include "draw/story_pictures.hpp"
#include "render/logo.hpp"
#include "render/shutter.hpp"

namespace piblocks {
namespace {

/// The place of the run whose last collision comes last; the first of several.
std::size_t longest(const std::vector<std::unique_ptr<CollisionLog>>& logs) {
  std::size_t found = 0;
  std::optional<Rational> latest;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const CollisionLog& log = *logs[i];
    if (log.size() == 0) continue;
    Rational last = time_of(Instant::last(), log);
    if (latest && last <= *latest) continue;
    latest = std::move(last);
    found = i;
  }
  return found;
}

}  // namespace

Run::Run(Scene scene, std::unique_ptr<CollisionLog> log, FilmUse use)
    : scene_(std::move(scene)), log_(std::move(log)) {
  if (use == FilmUse::pictures) composition_.emplace(scene_, *log_, read_logo(scene_));
}

DrawList Run::picture(const FrameTime& shown) const {
  return composition_->frame({log_->state_at(shown.time), shown.time, shown.slower},
                             expose(*log_, shown.exposure));
}

FilmPart::FilmPart(const Scene& scene, FilmUse use) { show_one(scene, use); }

FilmPart::FilmPart(const Runs& runs, const View& film, FilmUse use) {
  if (runs.size() == 1) {
    show_one(with_film_view(runs.front(), film), use);
  } else {
    compare(runs, film, use);
  }
}

FilmPart::FilmPart(const Card& card, const View& film, FilmUse use) {
  if (use == FilmUse::pictures) card_ = compose_card(card.lines, film);
  const Integer frames = ceil(card.length_s * film.frame_rate);
  if (frames > kMaxFrames) {
    throw UsageError(fmt::format("seconds = {}: {} frames are more than {}", to_text(card.length_s),
                                 readable(frames), readable(kMaxFrames)));
  }
  frame_count_ = frames.get_si();
}

void FilmPart::show_one(Scene scene, FilmUse use) {
  auto log = make_collision_log(scene.system);
  schedule_ = make_schedule(scene, *log);
  frame_count_ = film_frames(*schedule_);
  runs_.emplace_back(std::move(scene), std::move(log), use);
}

void FilmPart::compare(const Runs& runs, const View& film, FilmUse use) {
  split_.emplace(film, runs.size());
  std::vector<std::unique_ptr<CollisionLog>> logs;
  for (const Scene& run : runs) logs.push_back(make_collision_log(run.system));
  const std::size_t leader = longest(logs);
  const Scene leading = with_film_view(runs[leader], film);
  schedule_ = make_schedule(leading, *logs[leader]);
  frame_count_ = film_frames(*schedule_);
  const Span span = span_of(leading, *logs[leader]);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Scene run = with_film_view(runs[i], film);
    run.view.width_px = split_->cells()[i].width_px;
    run.view.height_px = split_->cells()[i].height_px;
    run.time = {span.from, span.to, leading.time.speed};
    run.pacing = leading.pacing;
    runs_.emplace_back(std::move(run), std::move(logs[i]), use);
  }
}

PixelRect FilmPart::cell(std::size_t run) const {
  if (split_) return split_->cells()[run];
  const View& view = runs_[run].scene().view;
  return {0, 0, view.width_px, view.height_px};
}

DrawList FilmPart::frame(std::int64_t number) const {
  if (runs_.empty()) return card_;
  if (!split_) return runs_.front().frame(*schedule_, number);
  std::vector<DrawList> pictures;
  pictures.reserve(runs_.size());
  for (const Run& run : runs_) pictures.push_back(run.frame(*schedule_, number));
  return split_->compose(std::move(pictures));
}

}  // namespace piblocks
