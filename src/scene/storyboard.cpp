#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/storyboard.hpp>

#include <algorithm>

#include "scene/scene_keys.hpp"

namespace piblocks {
namespace {

void add_problems(const Card& card, const std::string& place, std::vector<std::string>& problems) {
  if (card.lines.empty() || card.lines.size() > kMaxCardLines) {
    problems.push_back(fmt::format("{}: card: must have from 1 to {} lines", place, kMaxCardLines));
  }
  if (std::ranges::any_of(card.lines, &std::string::empty)) {
    problems.push_back(fmt::format("{}: card: must not have an empty line", place));
  }
  if (card.length_s <= 0) {
    problems.push_back(
        fmt::format("{}: seconds = {}: must be greater than 0", place, to_text(card.length_s)));
  }
}

void add_problems(const Runs& runs, const View& film, const std::string& place,
                  std::vector<std::string>& problems) {
  if (runs.empty() || runs.size() > kMaxCompared) {
    problems.push_back(fmt::format("{}: compare: must be from 2 to {} runs", place, kMaxCompared));
  }
  for (const Scene& run : runs) {
    for (const Problem& problem : problems_of(with_film_view(run, film))) {
      problems.push_back(fmt::format("{}: {} {}", place, problem.key, problem.reason));
    }
  }
}

/// No value has a tab in it, so nothing can be taken for something else.
std::string described(const Scene& scene) {
  std::string text;
  for (const auto& [key, value] : describe(scene)) {
    if (!is_film_key(key)) text += fmt::format("\t{} = {}", key, value);
  }
  return text;
}

std::string described(const StoryPart& part) {
  std::string text = "fade = " + part.fade_s.get_str();
  if (const auto* card = std::get_if<Card>(&part.content)) {
    return fmt::format("{}\tseconds = {}\t{}", text, card->length_s.get_str(),
                       fmt::join(card->lines, "\t"));
  }
  for (const Scene& run : std::get<Runs>(part.content)) text += described(run);
  return text;
}

}  // namespace

const View& view_of(const Script& script) {
  if (const auto* scene = std::get_if<Scene>(&script)) return scene->view;
  return std::get<Storyboard>(script).view;
}

const Sound& sound_of(const Script& script) {
  return std::visit([](const auto& any) -> const Sound& { return any.sound; }, script);
}

Scene with_film_view(Scene scene, const View& film) {
  scene.view.width_px = film.width_px;
  scene.view.height_px = film.height_px;
  scene.view.frame_rate = film.frame_rate;
  scene.view.background = film.background;
  scene.view.theme = film.theme;
  return scene;
}

std::vector<std::string> problems_of(const Storyboard& story) {
  std::vector<std::string> problems;
  if (story.parts.empty() || story.parts.size() > kMaxStoryParts) {
    problems.push_back(fmt::format("storyboard: must have from 1 to {} parts", kMaxStoryParts));
  }
  Scene film;
  film.golden = story.golden;
  for (const Problem& problem : problems_of(with_film_view(film, story.view))) {
    problems.push_back(fmt::format("storyboard: {} {}", problem.key, problem.reason));
  }
  for (std::size_t i = 0; i < story.parts.size(); ++i) {
    const StoryPart& part = story.parts[i];
    const std::string place = part.origin.empty() ? fmt::format("part {}", i + 1) : part.origin;
    if (part.fade_s < 0 || (part.fade_s > 0 && i == 0)) {
      problems.push_back(
          fmt::format("{}: fade = {}: must {}", place, to_text(part.fade_s),
                      i == 0 ? "be 0, since no part is before the first" : "not be less than 0"));
    }
    if (const auto* card = std::get_if<Card>(&part.content)) {
      add_problems(*card, place, problems);
    } else {
      add_problems(std::get<Runs>(part.content), story.view, place, problems);
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
  for (std::size_t i = 0; i < story.parts.size(); ++i) {
    values.emplace_back(fmt::format("part-{}", i + 1), described(story.parts[i]));
  }
  return values;
}

}  // namespace piblocks
