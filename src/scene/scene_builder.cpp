#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/scene.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
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
      // Found from where the scene is, wherever the program is started.
      if (entry.key == "show.logo" && !scene_.show.logo.empty()) {
        scene_.show.logo = std::filesystem::path(path).parent_path() / scene_.show.logo;
      }
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
  if (key == "red.width") {
    width_by_mass_ = values == Values{"by-mass"};
    if (width_by_mass_) return;
  }
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
  if (width_by_mass_) scene.system.red.width = width_by_mass(scene.system);
  std::vector<std::string> problems = problems_;
  for (const Problem& problem : problems_of(scene)) {
    const auto origin = origins_.find(problem.key);
    const std::string place = origin == origins_.end() ? "scene" : origin->second;
    problems.push_back(fmt::format("{}: {} {}", place, problem.key, problem.reason));
  }
  if (!problems.empty()) throw SceneError(std::move(problems));
  return scene;
}

Rational width_by_mass(const BlockSystem& system) {
  if (system.blue.mass <= 0 || system.red.mass <= 0) return system.red.width;
  // Either mass may be beyond what a double holds.
  const auto log_2 = [](const Integer& value) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
    return static_cast<double>(exponent) + std::log2(mantissa);
  };
  const Rational ratio = system.red.mass / system.blue.mass;
  const double hundreds = (log_2(ratio.get_num()) - log_2(ratio.get_den())) / std::log2(100.0);
  const double factor = std::clamp(1 + hundreds / 8, 0.5, 1.5);
  // To a thousandth, which makes the eighths exact.
  return system.blue.width * Rational(Integer(std::lround(factor * 1000))) / 1000;
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
