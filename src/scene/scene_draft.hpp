// The values of one scene while they are collected, and where each came from.
// In: tables of a scene file, and options of the same keys. Out: the scene, and what is wrong with
// it.
#pragma once

#include <piblocks/scene.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene_keys.hpp"
#include "scene/toml_file.hpp"

namespace piblocks {

class SceneDraft {
 public:
  /// @param place  named in messages about values that nobody has set.
  explicit SceneDraft(std::string place) : place_(std::move(place)) {}

  /// Sets every key of the table, which is in this file.
  void read(const std::string& path, const TomlTable& table);
  /// Sets one key. @param origin  named in messages, such as "--size".
  void set(const std::string& origin, const std::string& key, const Values& values);
  /// A draft that begins with the values of this one, without what was wrong with their text.
  SceneDraft next(const std::string& place) const;

  Scene scene() const;
  /// Everything that is wrong, also with text: origin, key, value and reason.
  /// @param of_film  leaves out values that are no keys of a whole film.
  std::vector<std::string> problems(bool of_film = false) const;

 private:
  void set_key(const std::string& origin, const std::string& key, const Values& values);
  void add_problem(const std::string& origin, const std::string& text);

  Scene scene_;
  std::optional<Rational> mass_ratio_;
  bool width_by_mass_ = false;
  std::map<std::string, std::string> origins_;  // by key
  std::string place_;
  std::vector<std::string> problems_;  // of text that could not be read
};

}  // namespace piblocks
