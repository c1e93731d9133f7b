// Every key of a scene: how its value is read and written; rules that several kinds of values
// share; a whole script as text.
// In: a key and the texts of its value. Out: that value in the scene, or its texts again; problems.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <cstddef>
#include <exception>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "physics/problems.hpp"

namespace piblocks {

/// One text, or the texts of a list.
using Values = std::vector<std::string>;

struct SceneKey {
  const char* name;
  void (*set)(Scene& scene, const Values& values);  ///< @throws UsageError
  Values (*get)(const Scene& scene);                ///< exact: read back, they give the same value
};

std::span<const SceneKey> scene_keys();
/// Nothing if there is no such key.
const SceneKey* find_scene_key(std::string_view name);

/// Keys that set the same value, of which a table may have only one.
struct KeysOfOneValue {
  const char* value;  ///< in messages
  std::vector<std::string> keys;
};
std::span<const KeysOfOneValue> keys_of_one_value();
/// Whether two keys are one, or set the same value.
bool set_same_value(std::string_view one, std::string_view other);

/// Whether the key is of blue, red or their wall.
bool is_short_key(std::string_view key);

/// Whether the key is for a whole film and not for a segment of a storyboard.
bool is_film_key(std::string_view key);

/// The values of a list, or those in one text with commas.
Values list_of(const Values& values);

/// The value of a key that takes one. @throws UsageError if there are more.
const std::string& single(const Values& values);

/// "true" or "false". @throws UsageError if it is neither.
bool parse_bool(const Values& values);

/// A text of a list as the key's get() gives it; the text itself if it cannot be read.
std::string normalized_item(std::string_view key, const std::string& text);

/// What is wrong with texts that mean no value of the key.
Problem problem_of_text(const std::string& key, const Values& values, const std::exception& error);

/// Everything that is wrong with a scene file and options, in the order in which it is found. A
/// problem of every part is there once.
class ProblemLines {
 public:
  void add(Problem problem) {
    if (known_.insert(problem.line()).second) list_.push_back(std::move(problem));
  }
  /// @param origin  such as "--size" or "story.toml:12"
  void add(const std::string& origin, Problem problem) {
    problem.origin = origin;
    add(std::move(problem));
  }
  /// @param line  of the file
  void add(const std::string& path, std::size_t line, Problem problem) {
    add(fmt::format("{}:{}", path, line), std::move(problem));
  }
  void add(const ProblemLines& more) {
    for (const Problem& problem : more.list_) add(problem);
  }

  bool empty() const noexcept { return list_.empty(); }
  /// @throws SceneError with all of them, if there are any.
  void require_none() const {
    if (!list_.empty()) throw SceneError(list_);
  }

 private:
  std::vector<Problem> list_;
  std::set<std::string> known_;  ///< lines
};

/// A title, a caption or a line of a card.
void check_line(const char* key, std::string_view text, SceneProblems& problems);

/// Problems with "fade", "card", "seconds" and "compare" of a segment; its scenes have their own
/// problems_of().
std::vector<Problem> problems_of(const Segment& segment, bool is_first);

/// A script as the text of a scene file, which reads back as the same script. Keys at their
/// defaults are left out. Numbers are exact, as strings: "1/3". The path of a logo is absolute.
std::string scene_toml(const Script& script);

}  // namespace piblocks
