#include "scene/scene_draft.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>
#include <utility>

namespace piblocks {
namespace {

/// @param keys  that set the same value, of which a table may have only one.
/// @return a message if the table has several of them; otherwise empty.
std::string conflict_of(const TomlTable& table, std::vector<std::string_view> keys,
                        const char* what) {
  std::erase_if(keys, [&](std::string_view key) {
    return std::ranges::count(table.entries, key, &TomlEntry::key) == 0;
  });
  if (keys.size() < 2) return {};
  return fmt::format("{} {} set {}; leave out {} of them", fmt::join(keys, " and "),
                     keys.size() == 2 ? "both" : "all", what,
                     keys.size() == 2 ? "one" : "all but one");
}

int parse_digits(const Values& values) {
  const std::string& text = single(values);
  int digits = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), digits);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  if (!is_number || digits < 1 || digits > kMaxDigits) {
    throw UsageError(fmt::format("must be a whole number from 1 to {}", kMaxDigits));
  }
  return digits;
}

/// Of the lecture themes, unless a scene says otherwise.
const Rational kLectureShutter(1, 2);

}  // namespace

void SceneDraft::read(const std::string& path, const TomlTable& table) {
  for (const std::string& problem :
       {conflict_of(table, {"time.speed", "time.duration"}, "the speed"),
        conflict_of(table, {"digits", "mass-ratio", "red.mass"}, "the mass of red")}) {
    if (problem.empty()) continue;
    add_problem(table.line > 0 ? fmt::format("{}:{}", path, table.line) : path, problem);
  }
  for (const TomlEntry& entry : table.entries) {
    const std::string origin = fmt::format("{}:{}", path, entry.line);
    if (entry.key == "part" && !entry.tables.empty()) {
      add_problem(origin, "part: a single scene has no parts; this is a storyboard");
    } else if (entry.problem.empty()) {
      set(origin, entry.key, entry.values);
      // Relative to the folder of the scene file.
      if (entry.key == "show.logo" && !scene_.show.logo.empty()) {
        scene_.show.logo = std::filesystem::path(path).parent_path() / scene_.show.logo;
      }
    } else {
      add_problem(origin, fmt::format("{}: {}", entry.key, entry.problem));
    }
  }
}

void SceneDraft::set(const std::string& origin, const std::string& key, const Values& values) {
  try {
    set_key(origin, key, values);
  } catch (const UsageError& error) {
    add_problem(origin, fmt::format("{} = {}: {}", key, joined(values), error.what()));
  }
}

void SceneDraft::set_key(const std::string& origin, const std::string& key, const Values& values) {
  if (key == "digits") return set_mass_ratio(origin, parse_digits(values), std::nullopt);
  if (key == "mass-ratio") {
    return set_mass_ratio(origin, std::nullopt, parse_rational(single(values)));
  }
  const std::span<const SceneKey> keys = scene_keys();
  const auto found = std::ranges::find(keys, std::string_view(key), &SceneKey::name);
  if (found == keys.end()) {
    add_problem(origin, fmt::format("{}: unknown key", key));
    return;
  }
  origins_[key] = origin;
  if (key == "red.mass") set_mass_ratio(origin, std::nullopt, std::nullopt);
  if (key == "red.width") {
    width_by_mass_ = values == Values{"by-mass"};
    if (width_by_mass_) return;
  }
  found->set(scene_, values);
}

void SceneDraft::set_mass_ratio(const std::string& origin, std::optional<int> digits,
                                std::optional<Rational> ratio) {
  digits_ = digits;
  mass_ratio_ = std::move(ratio);
  origins_["red.mass"] = origin;
}

void SceneDraft::add_problem(const std::string& origin, const std::string& text) {
  problems_.push_back(fmt::format("{}: {}", origin, text));
}

SceneDraft SceneDraft::next(const std::string& origin) const {
  SceneDraft draft = *this;
  draft.problems_.clear();
  draft.default_origin_ = origin;
  return draft;
}

Scene SceneDraft::scene() const {
  Scene scene = scene_;
  const std::optional<Rational> ratio =
      digits_ ? std::optional(mass_ratio_of(*digits_, scene.show.base)) : mass_ratio_;
  if (ratio) scene.system.red.mass = scene.system.blue.mass * *ratio;
  if (width_by_mass_) scene.system.red.width = width_by_mass(scene.system);
  // A blurred frame cannot be transparent.
  const bool is_opaque = scene.view.background == Background::opaque;
  if (is_lecture(scene.view.theme) && is_opaque && !origins_.contains("view.shutter")) {
    scene.view.shutter = kLectureShutter;
  }
  return scene;
}

std::vector<std::string> SceneDraft::problems(bool of_film) const {
  std::vector<std::string> problems = problems_;
  for (const auto& [key, reason] : problems_of(scene())) {
    if (of_film && !is_film_key(key)) continue;
    const auto origin = origins_.find(key);
    problems.push_back(fmt::format(
        "{}: {} {}", origin == origins_.end() ? default_origin_ : origin->second, key, reason));
  }
  return problems;
}

}  // namespace piblocks
