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

namespace {

/// Keys of which a table may have one only, and what they set.
struct Rivals {
  std::vector<std::string_view> keys;
  const char* what;
};

/// @returns what is wrong; empty if nothing is.
std::string rivalry(const TomlTable& table, const Rivals& rivals) {
  std::vector<std::string_view> present;
  for (const std::string_view key : rivals.keys) {
    if (std::ranges::count(table.entries, key, &TomlEntry::key) > 0) present.push_back(key);
  }
  if (present.size() < 2) return {};
  return fmt::format("{} {} set {}; leave out {} of them", fmt::join(present, " and "),
                     present.size() == 2 ? "both" : "all", rivals.what,
                     present.size() == 2 ? "one" : "all but one");
}

/// The mass ratio that counts so many digits.
Rational mass_ratio_of_digits(const Values& values) {
  const Rational digits = parse_rational(single(values));
  if (digits.get_den() != 1 || digits < 1 || digits > kMaxDigits) {
    throw UsageError(fmt::format("must be a whole number from 1 to {}", kMaxDigits));
  }
  return power(100, digits.get_num().get_ui() - 1);
}

Rational positive(const Values& values) {
  Rational value = parse_rational(single(values));
  if (value <= 0) throw UsageError("must be greater than 0");
  return value;
}

}  // namespace

void SceneBuilder::read_file(const std::string& path) { read(path, read_toml(path)); }

void SceneBuilder::read(const std::string& path, const TomlTable& table) {
  for (const Rivals& rivals : {Rivals{{"time.speed", "time.duration"}, "the speed"},
                               Rivals{{"digits", "mass-ratio", "red.mass"}, "the mass of red"}}) {
    const std::string problem = rivalry(table, rivals);
    const std::string place = table.line > 0 ? fmt::format("{}:{}", path, table.line) : path;
    if (!problem.empty()) add_problem(place, problem);
  }
  for (const TomlEntry& entry : table.entries) {
    const std::string origin = fmt::format("{}:{}", path, entry.line);
    if (entry.key == "part" && !entry.tables.empty()) {
      add_problem(origin, "part: a single scene has no parts; this is a storyboard");
    } else if (entry.problem.empty()) {
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
  try {
    set_key(origin, key, values);
  } catch (const UsageError& error) {
    add_problem(origin, fmt::format("{} = {}: {}", key, joined(values), error.what()));
  }
}

void SceneBuilder::set_key(const std::string& origin, const std::string& key,
                           const Values& values) {
  if (key == "digits") return set_mass_ratio(origin, mass_ratio_of_digits(values));
  if (key == "mass-ratio") return set_mass_ratio(origin, positive(values));
  const std::span<const SceneKey> keys = scene_keys();
  const auto found = std::ranges::find(keys, std::string_view(key), &SceneKey::name);
  if (found == keys.end()) {
    add_problem(origin, fmt::format("{}: unknown key", key));
    return;
  }
  origins_[key] = origin;
  if (key == "red.mass") mass_ratio_.reset();
  if (key == "red.width") {
    width_by_mass_ = values == Values{"by-mass"};
    if (width_by_mass_) return;
  }
  found->set(scene_, values);
}

void SceneBuilder::add_problem(const std::string& origin, const std::string& text) {
  problems_.push_back(fmt::format("{}: {}", origin, text));
}

std::string SceneBuilder::described(const Problem& problem) const {
  const auto origin = origins_.find(problem.key);
  const std::string& place = origin == origins_.end() ? place_ : origin->second;
  return fmt::format("{}: {} {}", place, problem.key, problem.reason);
}

Scene SceneBuilder::build() const {
  Scene scene = scene_;
  if (mass_ratio_) scene.system.red.mass = scene.system.blue.mass * *mass_ratio_;
  if (width_by_mass_) scene.system.red.width = width_by_mass(scene.system);
  std::vector<std::string> problems = problems_;
  for (const Problem& problem : problems_of(scene)) problems.push_back(described(problem));
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

}  // namespace piblocks
