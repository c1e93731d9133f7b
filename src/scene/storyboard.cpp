#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/script.hpp>

#include <algorithm>

#include "scene/scene_keys.hpp"

namespace piblocks {
namespace {

void check_lines(const char* key, const std::vector<std::string>& lines, SceneProblems& problems) {
  problems.require(!lines.empty() && lines.size() <= kMaxCardLines, key,
                   "must be from 1 to {} lines of text", kMaxCardLines);
  problems.require(std::ranges::none_of(lines, &std::string::empty), key,
                   "must not have an empty line");
  for (const std::string& line : lines) check_line(key, line, problems);
}

/// Whether all of `before` is in `after`, in its order.
bool is_within(std::string_view before, std::string_view after) {
  for (const char each : after) {
    if (!before.empty() && each == before.front()) before.remove_prefix(1);
  }
  return before.empty();
}

void check(const Card& card, SceneProblems& problems) {
  check_lines("card", card.lines, problems);
  problems.require_positive("seconds", card.length_s);
  if (card.becomes.empty()) return;
  check_lines("becomes", card.becomes, problems);
  problems.require(card.becomes.size() >= card.lines.size(), "becomes",
                   "must have at least the {} lines of the card", card.lines.size());
  for (std::size_t i = 0; i < std::min(card.lines.size(), card.becomes.size()); ++i) {
    problems.require(is_within(card.lines[i], card.becomes[i]), "becomes",
                     "'{}' must have all characters of '{}' in their order", card.becomes[i],
                     card.lines[i]);
  }
}

void check(const Scenes& scenes, SceneProblems& problems) {
  problems.require(!scenes.empty() && scenes.size() <= kMaxCompared, "compare",
                   "must be from 2 to {} runs", kMaxCompared);
}

/// Values have no tabs, so the text is unambiguous.
std::string described(const Scene& scene) {
  std::string text;
  for (const auto& [key, value] : describe(scene)) {
    if (!is_film_key(key)) text += fmt::format("\t{} = {}", key, value);
  }
  return text;
}

std::string described(const Segment& segment) {
  std::string text = "fade = " + segment.fade_s.get_str();
  if (segment.split != Split::automatic) text += "\tsplit = " + exact_text(segment.split);
  if (const auto* card = std::get_if<Card>(&segment.content)) {
    text +=
        fmt::format("\tseconds = {}\t{}", card->length_s.get_str(), fmt::join(card->lines, "\t"));
    if (card->becomes.empty()) return text;
    return fmt::format("{}\tbecomes\t{}", text, fmt::join(card->becomes, "\t"));
  }
  for (const Scene& scene : std::get<Scenes>(segment.content)) text += described(scene);
  return text;
}

}  // namespace

const View& view_of(const Script& script) {
  return std::visit([](const auto& any) -> const View& { return any.view; }, script);
}

const Sound& sound_of(const Script& script) {
  return std::visit([](const auto& any) -> const Sound& { return any.sound; }, script);
}

std::vector<const Scene*> scenes_of(const Script& script) {
  if (const auto* scene = std::get_if<Scene>(&script)) return {scene};
  std::vector<const Scene*> all;
  for (const Segment& segment : std::get<Storyboard>(script).segments) {
    const auto* const scenes = std::get_if<Scenes>(&segment.content);
    if (scenes == nullptr) continue;
    for (const Scene& scene : *scenes) all.push_back(&scene);
  }
  return all;
}

Scene with_film_view(Scene scene, const View& film) {
  scene.view.width_px = film.width_px;
  scene.view.height_px = film.height_px;
  scene.view.frame_rate = film.frame_rate;
  scene.view.background = film.background;
  scene.view.theme = film.theme;
  scene.view.colors = film.colors;
  return scene;
}

std::vector<Problem> problems_of(const Segment& segment, bool is_first) {
  SceneProblems problems;
  std::visit([&](const auto& content) { check(content, problems); }, segment.content);
  problems.require(segment.fade_s >= 0, "fade", "= {}: must not be less than 0", segment.fade_s);
  problems.require(segment.fade_s <= 0 || !is_first, "fade",
                   "= {}: no part is before the first; leave it out", segment.fade_s);
  return problems.take();
}

std::vector<Problem> problems_of(const Storyboard& story) {
  std::vector<Problem> problems;
  if (story.segments.empty() || story.segments.size() > kMaxSegments) {
    problems.push_back(
        {.reason = fmt::format("storyboard: must have from 1 to {} parts", kMaxSegments)});
  }
  const auto add = [&](const std::string& origin, const std::vector<Problem>& more) {
    for (Problem problem : more) {
      problem.origin = origin;
      problems.push_back(std::move(problem));
    }
  };
  Scene film;
  film.golden = story.golden;
  add("storyboard", problems_of(with_film_view(film, story.view)));
  for (std::size_t i = 0; i < story.segments.size(); ++i) {
    const Segment& segment = story.segments[i];
    const std::string origin =
        segment.origin.empty() ? fmt::format("part {}", i + 1) : segment.origin;
    add(origin, problems_of(segment, i == 0));
    if (const auto* const scenes = std::get_if<Scenes>(&segment.content)) {
      for (const Scene& scene : *scenes)
        add(origin, problems_of(with_film_view(scene, story.view)));
    }
  }
  return problems;
}

std::vector<std::pair<std::string, std::string>> describe(const Storyboard& story) {
  Scene film;
  film.sound = story.sound;
  std::vector<std::pair<std::string, std::string>> values;
  for (auto& [key, value] : describe(with_film_view(film, story.view))) {
    if (is_film_key(key)) values.emplace_back(std::move(key), std::move(value));
  }
  for (std::size_t i = 0; i < story.segments.size(); ++i) {
    values.emplace_back(fmt::format("part-{}", i + 1), described(story.segments[i]));
  }
  return values;
}

}  // namespace piblocks
