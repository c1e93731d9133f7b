// The values of one scene while they are collected, and the origin of each.
// In: tables of a scene file, and options of the same keys. Out: the scene, and its problems.
#pragma once

#include <piblocks/scene.hpp>

#include <map>
#include <optional>
#include <string>

#include "scene/body_keys.hpp"
#include "scene/scene_keys.hpp"
#include "scene/toml_file.hpp"

namespace piblocks {

class SceneDraft {
 public:
  /// @param origin  named in messages about values that have not been set.
  explicit SceneDraft(std::string origin) : default_origin_(std::move(origin)) {}

  /// Sets every key of a table of this file.
  void read(const std::string& path, TomlTable table);
  /// Sets one key. @param origin  named in messages, such as "--size".
  void set(const std::string& origin, const std::string& key, const Values& values);
  /// Leaves out "body 2.label", a property of a [[body]] that is read later, or "body 2".
  void leave_out_body_key(const std::string& key) { bodies_.leave_out(key); }
  /// A draft that begins with the values of this one, without its problems, and reads all keys.
  SceneDraft next(const std::string& origin) const;

  /// The scene. Adds everything that is wrong with it, also text that could not be read: origin,
  /// key, value and reason.
  /// @param of_film  whether to leave out values of keys that are not for a whole film.
  Scene make(ProblemLines& problems, bool of_film = false) const;

 private:
  Scene scene(ProblemLines& problems) const;
  void set_entry(const std::string& path, TomlEntry& entry);
  void read_bodies(const std::string& path, TomlEntry& entry);
  void add_unread(const std::string& origin, const std::string& key, const std::string& reason);
  void change_wall(Scene& scene) const;
  bool set_wall(const std::string& key, const Values& values);
  void check_bodies(ProblemLines& problems) const;
  std::string origin_of(const std::string& key) const;
  void set_key(const std::string& origin, const std::string& key, const Values& values);
  /// What red's mass follows from: one of the two, or neither.
  void set_mass_ratio(const std::string& origin, std::optional<int> digits,
                      std::optional<Rational> ratio);

  Scene scene_;
  BodyDraft bodies_;
  bool has_wall_ = true;
  std::optional<Rational> wall_mass_;  ///< nothing: no collision moves the wall
  Rational wall_velocity_;
  std::optional<Rational> mass_ratio_;
  std::optional<int> digits_;  // their mass ratio depends on the base, which may be set later
  bool width_by_mass_ = false;
  std::map<std::string, std::string> origins_;  // by key
  std::string default_origin_;
  ProblemLines problems_;  // of text that could not be read
};

}  // namespace piblocks
