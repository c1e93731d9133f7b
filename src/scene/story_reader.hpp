// The parts of a storyboard, from the tables of its file.
// In: the values for all parts, and a table for each. Out: the storyboard, and its problems.
#pragma once

#include <piblocks/script.hpp>

#include <map>
#include <string>
#include <vector>

#include "scene/scene_draft.hpp"
#include "scene/toml_file.hpp"

namespace piblocks {

class StoryReader {
 public:
  /// @param path  of the file, named in messages.
  StoryReader(std::string path, const SceneDraft& film);

  /// Adds the segment that a [[part]] describes.
  void read(const TomlTable& table);

  const Storyboard& story() const { return story_; }
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  /// Origins of the keys that are not a scene's, by key.
  using Origins = std::map<std::string, std::string>;

  Segment segment_of(const TomlTable& table, Origins& origins);
  Card card_of(const TomlTable& table, Origins& origins);
  Runs runs_of(const TomlTable& table);
  /// The keys of one scene. @param problem_of  says why a key may not be here, or nullptr.
  template <typename Rule>
  TomlTable checked(const TomlTable& table, const Rule& problem_of);
  std::vector<SceneDraft> compared(const TomlEntry& compare, const SceneDraft& common);
  template <typename Target, typename Parse>
  void take(const TomlTable& table, const char* key, Target& target, const Parse& parse,
            Origins& origins);
  void add_problem(const TomlEntry& entry, const std::string& text);
  std::string origin_of(const TomlEntry& entry) const;

  std::string path_;
  const SceneDraft& film_;
  Storyboard story_;
  std::vector<std::string> problems_;
};

}  // namespace piblocks
