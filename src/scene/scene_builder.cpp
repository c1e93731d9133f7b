#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/scene.hpp>

#include <algorithm>
#include <utility>

#include "scene/scene_keys.hpp"
#include "scene/toml_file.hpp"

namespace piblocks {

void SceneBuilder::read_file(const std::string& path) {
  const std::vector<TomlEntry> entries = read_toml(path);
  const auto has = [&](const char* key) {
    return std::ranges::count(entries, key, &TomlEntry::key);
  };
  if (has("time.speed") && has("time.duration")) {
    add_problem(path, "time.speed and time.duration both set the speed; leave out one of them");
  }
  for (const TomlEntry& entry : entries) {
    const std::string origin = fmt::format("{}:{}", path, entry.line);
    if (entry.problem.empty()) {
      set_values(origin, entry.key, entry.values);
    } else {
      add_problem(origin, fmt::format("{}: {}", entry.key, entry.problem));
    }
  }
}

void SceneBuilder::set(const std::string& origin, const std::string& key, const std::string& text) {
  set_values(origin, key, {text});
}

void SceneBuilder::set_mass_ratio(const std::string& origin, const Rational& ratio) {
  mass_ratio_ = ratio;
  origins_["red.mass"] = origin;
}

void SceneBuilder::set_values(const std::string& origin, const std::string& key,
                              const Values& values) {
  const std::span<const SceneKey> keys = scene_keys();
  const auto found = std::ranges::find(keys, std::string_view(key), &SceneKey::name);
  if (found == keys.end()) {
    add_problem(origin, fmt::format("{}: unknown key", key));
    return;
  }
  origins_[key] = origin;
  try {
    found->set(scene_, values);
  } catch (const UsageError& error) {
    add_problem(origin, fmt::format("{} = {}: {}", key, joined(values), error.what()));
  }
}

void SceneBuilder::add_problem(const std::string& origin, const std::string& text) {
  problems_.push_back(fmt::format("{}: {}", origin, text));
}

Scene SceneBuilder::build() const {
  Scene scene = scene_;
  if (mass_ratio_) scene.system.red.mass = scene.system.blue.mass * *mass_ratio_;
  std::vector<std::string> problems = problems_;
  for (const Problem& problem : problems_of(scene)) {
    const auto origin = origins_.find(problem.key);
    const std::string place = origin == origins_.end() ? "scene" : origin->second;
    problems.push_back(fmt::format("{}: {} {}", place, problem.key, problem.reason));
  }
  if (!problems.empty()) throw SceneError(std::move(problems));
  return scene;
}

std::vector<std::pair<std::string, std::string>> describe(const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const SceneKey& key : scene_keys()) {
    values.emplace_back(key.name, fmt::format("{}", fmt::join(key.get(scene), ", ")));
  }
  return values;
}

End parse_end(std::string_view text) {
  constexpr std::string_view kLast = "last";
  if (!text.starts_with(kLast)) return {false, parse_rational(text)};
  const std::string_view offset = text.substr(kLast.size());
  if (offset.empty()) return {true, 0};
  if (offset.front() != '+') throw UsageError("must be a time, 'last' or 'last+S'");
  const Rational after = parse_rational(offset.substr(1));
  if (after < 0) throw UsageError("must not be before the last collision");
  return {true, after};
}

}  // namespace piblocks
