#include "render/film.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include "physics/blocks.hpp"

namespace piblocks {
namespace {

FilmPart made_from(const Segment& part, const View& view, FilmUse use) {
  if (const auto* card = std::get_if<Card>(&part.content)) return {*card, view, use};
  return {std::get<Runs>(part.content), view, use};
}

std::string place_of(const Storyboard& story, std::size_t part) {
  const std::string& origin = story.segments[part].origin;
  return origin.empty() ? fmt::format("part {}", part + 1) : origin;
}

}  // namespace

Film::Film(const Script& script, FilmUse use) : view_(view_of(script)) {
  if (const auto* scene = std::get_if<Scene>(&script)) {
    require_valid(problems_of(*scene));
    parts_.push_back({FilmPart(*scene, use)});
    frame_count_ = parts_.front().part.frame_count();
    return;
  }
  const auto& story = std::get<Storyboard>(script);
  std::vector<std::string> problems = problems_of(story);
  if (!problems.empty()) throw SceneError(std::move(problems));
  add_parts(story, use);
  place_parts(story);
}

void Film::add_parts(const Storyboard& story, FilmUse use) {
  std::vector<std::string> problems;
  for (std::size_t i = 0; i < story.segments.size(); ++i) {
    try {
      parts_.push_back({made_from(story.segments[i], view_, use)});
    } catch (const UsageError& error) {
      for (const std::string& problem : error.problems()) {
        problems.push_back(fmt::format("{}: {}", place_of(story, i), problem));
      }
    }
  }
  if (!problems.empty()) throw UsageError(std::move(problems));
}

void Film::place_parts(const Storyboard& story) {
  std::vector<std::string> problems;
  std::int64_t before = 0;  // frames of the part before that do not belong to its own fade
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    PlacedPart& placed = parts_[i];
    const std::int64_t own = placed.part.frame_count();
    const Rational& fade_s = story.segments[i].fade_s;
    const Integer fade = floor(fade_s * view_.frame_rate + Rational(1, 2));
    const std::int64_t room = i == 0 ? 0 : std::min(before, own - 1);
    if (fade > room) {
      problems.push_back(
          fmt::format("{}: fade = {}: must take at most {} frames, not {}: a fade is shorter than "
                      "its own part, and than what the fade before leaves of the part before",
                      place_of(story, i), to_text(fade_s), room, readable(fade)));
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
                               readable(frame_count_), readable(kMaxFrames)));
}

DrawList Film::frame(std::int64_t number) const {
  const auto next = std::ranges::upper_bound(parts_, number, {}, &PlacedPart::first_frame);
  const PlacedPart& placed = *std::prev(next);
  const std::int64_t in_part = number - placed.first_frame;
  DrawList list = placed.part.frame(in_part);
  if (in_part >= placed.fade_frames) return list;
  const PlacedPart& before = *std::prev(next, 2);
  const double opacity = double(in_part + 1) / double(placed.fade_frames + 1);
  return cross_fade(before.part.frame(number - before.first_frame), std::move(list), opacity);
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
      instant.is_time() ? Rational(0) : Rational(film.frame_count() - 1) / rate;
  const Integer frame = floor((anchor_s + instant.offset) * rate);
  if (frame >= 0 && frame < film.frame_count()) return frame.get_si();
  throw UsageError(fmt::format("{}: the storyboard's video lasts from 0 to {} s",
                               exact_text(instant), to_text(Rational(film.frame_count()) / rate)));
}

}  // namespace piblocks
