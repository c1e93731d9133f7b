#include "scene/scene_draft.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "core/nearest_name.hpp"
#include "core/whole_number.hpp"

namespace piblocks {
namespace {

/// @return a problem if the table has several keys of one value.
std::optional<Problem> conflict_of(const TomlTable& table, const KeysOfOneValue& of) {
  Values keys = of.keys;
  std::erase_if(keys, [&](const std::string& key) {
    return std::ranges::count(table.entries, key, &TomlEntry::key) == 0;
  });
  if (keys.size() < 2) return std::nullopt;
  return Problem{.key = keys.front(),
                 .reason = fmt::format("and {} {} set {}; leave out {} of them",
                                       fmt::join(keys.begin() + 1, keys.end(), " and "),
                                       keys.size() == 2 ? "both" : "all", of.value,
                                       keys.size() == 2 ? "one" : "all but one"),
                 .means_nothing = true};
}

/// Of the lecture themes, unless a scene says otherwise.
const Rational kLectureShutter(1, 2);

/// The key of the file that sets what problems_of() calls so.
std::string key_of(const Scene& scene, const std::string& key, bool has_bodies) {
  const std::size_t wall = number_in(key, "wall ");
  if (wall == 0) return key;
  const std::vector<Wall>& walls = scene.system.walls;
  const std::string& name = walls.at(wall - 1).name;
  const bool is_velocity = key.ends_with(".velocity");
  if (!has_bodies) return is_velocity ? "wall.velocity" : "wall.face";
  if (name == "left" || name == "right") return is_velocity ? "box.x-velocity" : "box.x";
  if (name == "lower" || name == "upper") return is_velocity ? "box.y-velocity" : "box.y";
  return fmt::format("wall {}{}", number_in(name, "slanted-"), key.substr(key.find('.')));
}

const std::vector<std::string> kListsOfTables = {"body", "wall", "part"};
const std::vector<std::string> kKeysOfParts = {"card", "becomes", "seconds",
                                               "fade", "compare", "split"};

/// The keys of a scene outside of its lists of tables.
std::vector<std::string> all_keys() {
  std::vector<std::string> names = {"digits",    "mass-ratio",     "restitution",
                                    "wall.mass", "wall.velocity",  "box.x",
                                    "box.y",     "box.x-velocity", "box.y-velocity"};
  for (const SceneKey& key : scene_keys()) names.emplace_back(key.name);
  return names;
}

std::string_view last_part(std::string_view key) { return key.substr(key.rfind('.') + 1); }
std::string first_part(const std::string& key) { return key.substr(0, key.find('.')); }

bool is_table(std::string_view name) {
  return std::ranges::any_of(
      all_keys(), [&](const std::string& key) { return key.starts_with(std::string(name) + '.'); });
}

/// Prefers a key in a table to one that differs in a few letters: 'theme' means 'view.theme'.
std::string advice(const std::string& key) {
  std::vector<std::string> names = all_keys();
  std::vector<std::string> same = names;
  std::erase_if(same, [&](const std::string& name) { return last_part(name) != last_part(key); });
  if (std::string near = did_you_mean(key, same); !near.empty()) return near;
  if (!same.empty()) return fmt::format("; did you mean '{}'?", fmt::join(same, "' or '"));
  names.insert(names.end(), kKeysOfParts.begin(), kKeysOfParts.end());
  return did_you_mean(key, names);
}

/// "unknown key; did you mean 'view.size'?"
std::string about_unknown_key(const std::string& key) {
  const std::string table = first_part(key);
  if (std::ranges::count(kKeysOfParts, key) > 0) return "unknown key; it belongs into a [[part]]";
  const bool is_of_walls = key == "wall.point" || key == "wall.normal";
  const std::string list =
      is_of_walls || !is_table(table) ? nearest_name(table, kListsOfTables) : "";
  if (!list.empty()) return fmt::format("unknown key; write [[{0}]], once for each {0}", list);
  if (is_table(key)) return fmt::format("unknown key; a table is written [{}]", key);
  return "unknown key" + advice(key);
}

/// The same for an entry, which may be a list of tables, such as [[bodi]]. Empty if the key exists.
std::string about_unknown(const TomlEntry& entry) {
  if (std::ranges::count(all_keys(), entry.key) > 0) return {};
  if (entry.tables.empty()) return about_unknown_key(entry.key);
  if (is_table(entry.key)) return fmt::format("is one table, written [{}]", entry.key);
  const std::string near = nearest_name(entry.key, kListsOfTables);
  if (!near.empty()) return fmt::format("unknown list of tables; did you mean '[[{}]]'?", near);
  const std::string known = did_you_mean(entry.key, kKeysOfParts);
  return "unknown list of tables" +
         (known.empty() ? "; there are [[body]], [[wall]] and [[part]]" : known);
}

}  // namespace

void SceneDraft::read(const std::string& path, TomlTable table) {
  for (const KeysOfOneValue& of : keys_of_one_value()) {
    const std::optional<Problem> problem = conflict_of(table, of);
    if (!problem) continue;
    problems_.add(table.line > 0 ? fmt::format("{}:{}", path, table.line) : path, *problem);
  }
  for (TomlEntry& entry : table.entries) set_entry(path, entry);
}

void SceneDraft::set_entry(const std::string& path, TomlEntry& entry) {
  const std::string origin = fmt::format("{}:{}", path, entry.line);
  if (entry.key == "body" || (entry.key == "wall" && !entry.tables.empty())) {
    read_bodies(path, entry);
  } else if (entry.key == "part" && !entry.tables.empty()) {
    add_unread(origin, "part", "a single scene has no parts; this is a storyboard");
  } else if (const std::string unknown = about_unknown(entry); !unknown.empty()) {
    add_unread(origin, entry.key, unknown);
  } else if (entry.problem.empty()) {
    set(origin, entry.key, entry.values);
    // Relative to the folder of the scene file.
    if (entry.key == "show.logo" && !scene_.show.logo.empty()) {
      scene_.show.logo = std::filesystem::path(path).parent_path() / scene_.show.logo;
    }
  } else {
    add_unread(origin, entry.key, entry.problem);
  }
}

void SceneDraft::add_unread(const std::string& origin, const std::string& key,
                            const std::string& reason) {
  problems_.add(origin, {.key = key, .reason = ": " + reason, .means_nothing = true});
}

void SceneDraft::read_bodies(const std::string& path, TomlEntry& entry) {
  if (entry.tables.empty()) {
    problems_.add(path, entry.line, {"body", ": is written [[body]], once for each"});
  } else if (entry.key == "wall") {
    bodies_.read_walls(path, entry.tables, problems_);
  } else {
    bodies_.read(path, std::move(entry.tables), problems_);
  }
}

/// @return whether it is a key of the box, or of a wall that recoils, moves or is not there
bool SceneDraft::set_wall(const std::string& key, const Values& values) {
  if (bodies_.set_box(key, values)) return true;
  if (key == "wall.velocity") {
    wall_velocity_ = parse_rational(single(values));
  } else if (key == "wall.face") {
    has_wall_ = values != Values{"-inf"};
    if (has_wall_) find_scene_key(key)->set(scene_, values);
  } else if (key == "wall.mass") {
    std::optional<Rational> mass;
    if (single(values) != "inf") mass = parse_rational(single(values));
    if (mass && (*mass <= 0 || !is_finite(*mass))) {
      throw UsageError("must be greater than 0, and within the range of a double or \"inf\"");
    }
    wall_mass_ = std::move(mass);
  } else {
    return false;
  }
  return true;
}

void SceneDraft::set(const std::string& origin, const std::string& key, const Values& values) {
  try {
    set_key(origin, key, values);
  } catch (const UsageError& error) {
    problems_.add(origin, problem_of_text(key, values, error));
  }
}

void SceneDraft::set_key(const std::string& origin, const std::string& key, const Values& values) {
  if (number_in(key, "body ") > 0) return bodies_.set(origin, key, values);
  if (key == "digits")
    return set_mass_ratio(origin, parse_int(single(values), 1, kMaxDigits), std::nullopt);
  if (key == "mass-ratio") {
    return set_mass_ratio(origin, std::nullopt, parse_rational(single(values), kMaxMassBits));
  }
  if (set_wall(key, values)) {
    origins_[key] = origin;
    return;
  }
  if (key == "restitution") {
    origins_[key] = origin;
    scene_.system.restitution = scene_.system.wall_restitution = parse_restitution(values);
    return;
  }
  const SceneKey* const found = find_scene_key(key);
  if (found == nullptr) {
    add_unread(origin, key, about_unknown_key(key));
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

SceneDraft SceneDraft::next(const std::string& origin) const {
  SceneDraft draft = *this;
  draft.problems_ = {};
  draft.bodies_.leave_out_nothing();
  draft.default_origin_ = origin;
  return draft;
}

Scene SceneDraft::scene(ProblemLines& problems) const {
  Scene scene = scene_;
  // A blurred frame cannot be transparent.
  const bool is_opaque = scene.view.background == Background::opaque;
  if (is_lecture(scene.view.theme) && is_opaque && !origins_.contains("view.shutter")) {
    scene.view.shutter = kLectureShutter;
  }
  if (!bodies_.empty()) {
    bodies_.put_into(scene, problems);
    View seen = scene.view;
    show_all(scene.system, scene.time, seen);
    if (!origins_.contains("view.x")) scene.view.x = seen.x;
    if (!origins_.contains("view.y")) scene.view.y = seen.y;
    return scene;
  }
  const std::optional<Rational> ratio =
      digits_ ? std::optional(mass_ratio_of(*digits_, scene.show.base)) : mass_ratio_;
  const Body& blue = scene.system.bodies[0];
  Body& red = scene.system.bodies[1];
  if (ratio) red.mass = *blue.mass * *ratio;
  if (width_by_mass_) red.size = width_by_mass(blue, red);
  change_wall(scene);
  return scene;
}

/// A wall of finite mass is a block, and one that moves the wall of a box.
void SceneDraft::change_wall(Scene& scene) const {
  constexpr int kColor = 140;  // between light and dark
  System& system = scene.system;
  const ExactVector face = system.walls[0].point;
  if (has_wall_ && !wall_mass_ && wall_velocity_ == 0) return;
  system.walls.clear();
  if (!has_wall_) return;
  if (!wall_mass_) return system.walls.push_back({"left", face, {1}, {wall_velocity_}});
  system.bodies.push_back({.mass = *wall_mass_,
                           .position = {face[0] - Rational(1, 2)},
                           .velocity = {wall_velocity_},
                           .name = "wall"});
  scene.styles.push_back({{{kColor, kColor, kColor}}, "wall"});
}

std::string SceneDraft::origin_of(const std::string& key) const {
  for (const std::string& set :
       {key, std::string(key.ends_with("restitution") ? "restitution" : "")}) {
    const auto origin = origins_.find(set);
    if (origin != origins_.end()) return origin->second;
  }
  const std::string of_table = bodies_.origin_of(key);
  return of_table.empty() ? default_origin_ : of_table;
}

/// Keys of blue, red and the wall, where there are bodies instead; and a box without bodies.
void SceneDraft::check_bodies(ProblemLines& problems) const {
  for (const auto& [key, origin] : origins_) {
    if (!bodies_.empty() && is_short_key(key)) {
      const bool is_ratio = key == "red.mass" && (digits_ || mass_ratio_);
      problems.add(origin, {is_ratio ? (digits_ ? "digits" : "mass-ratio") : key,
                            ": this scene has [[body]] instead of blue, red and the wall"});
    } else if (bodies_.empty() && key.starts_with("box.")) {
      problems.add(origin, {key, ": is the box of bodies, and there is no [[body]]"});
    }
  }
  for (const auto& [key, axis] :
       {std::pair("box.x-velocity", 0U), std::pair("box.y-velocity", 1U)}) {
    if (bodies_.empty() || !origins_.contains(key) || !bodies_.moves_no_wall(axis)) continue;
    problems.add(origins_.at(key), {key, ": moves an end of the box that has no wall"});
  }
  for (const char* const key : {"wall.mass", "wall.velocity"}) {
    if (has_wall_ || !origins_.contains(key)) continue;
    problems.add(origins_.at(key), {key, ": there is no wall, since wall.face is -inf"});
  }
  if (bodies_.empty() && bodies_.has_slanted_walls()) {
    problems.add(origin_of("wall"),
                 {"wall", ": [[wall]] is a wall of bodies, and there is no [[body]]"});
  }
}

Scene SceneDraft::make(ProblemLines& problems, bool of_film) const {
  ProblemLines found = problems_;
  Scene made = scene(found);
  check_bodies(found);
  for (Problem problem : problems_of(made)) {
    if (of_film && !is_film_key(problem.key)) continue;
    const bool follows_bodies =
        !bodies_.empty() && problem.key.starts_with("view.") && !origins_.contains(problem.key);
    if (follows_bodies && !found.empty()) continue;  // their problems are its cause
    problem.key = key_of(made, problem.key, !bodies_.empty());
    found.add(origin_of(problem.key), problem);
  }
  problems.add(found);
  return made;
}

}  // namespace piblocks
