#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <algorithm>

#include "scene/line.hpp"
#include "scene/scene_keys.hpp"
#include "scene/story_part.hpp"

namespace piblocks {
namespace {

std::vector<Problem> problems_of(const Card& card) {
  std::vector<Problem> problems;
  if (card.lines.empty() || card.lines.size() > kMaxCardLines) {
    problems.push_back({"card", fmt::format("must be from 1 to {} lines of text", kMaxCardLines)});
  }
  if (std::ranges::any_of(card.lines, &std::string::empty)) {
    problems.push_back({"card", "must not have an empty line"});
  }
  for (const std::string& line : card.lines) {
    const std::string problem = problem_of_line(line);
    if (!problem.empty()) problems.push_back({"card", problem});
  }
  if (card.length_s <= 0) {
    problems.push_back(
        {"seconds", fmt::format("= {}: must be greater than 0", to_text(card.length_s))});
  }
  return problems;
}

std::vector<Problem> problems_of(const Runs& runs) {
  if (!runs.empty() && runs.size() <= kMaxCompared) return {};
  return {{"compare", fmt::format("must be from 2 to {} runs", kMaxCompared)}};
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

std::vector<Problem> problems_of(const StoryPart& part, bool is_first) {
  std::vector<Problem> problems =
      std::visit([](const auto& content) { return problems_of(content); }, part.content);
  if (part.fade_s < 0) {
    problems.push_back(
        {"fade", fmt::format("= {}: must not be less than 0", to_text(part.fade_s))});
  }
  if (part.fade_s > 0 && is_first) {
    problems.push_back({"fade", fmt::format("= {}: no part is before the first; leave it out",
                                            to_text(part.fade_s))});
  }
  return problems;
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
  const auto add = [&](const std::string& place, const std::vector<Problem>& more) {
    for (const Problem& problem : more) {
      problems.push_back(fmt::format("{}: {} {}", place, problem.key, problem.reason));
    }
  };
  for (std::size_t i = 0; i < story.parts.size(); ++i) {
    const StoryPart& part = story.parts[i];
    const std::string place = part.origin.empty() ? fmt::format("part {}", i + 1) : part.origin;
    add(place, problems_of(part, i == 0));
    const Runs* const runs = std::get_if<Runs>(&part.content);
    if (runs == nullptr) continue;
    for (const Scene& run : *runs) add(place, problems_of(with_film_view(run, story.view)));
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
