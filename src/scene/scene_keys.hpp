// Every key of a scene: how its value is read and written; rules that several kinds of values
// share. In: a key and the texts of its value. Out: that value in the scene, or its texts again;
// problems.
#pragma once

#include <piblocks/script.hpp>

#include <exception>
#include <span>
#include <string>
#include <string_view>
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

/// The values as one text for a message.
std::string joined(const Values& values);

/// A text of a list as the key's get() gives it; the text itself if it cannot be read.
std::string normalized_item(std::string_view key, const std::string& text);

/// What is wrong with texts that mean no value of the key.
Problem problem_of_text(const std::string& key, const Values& values, const std::exception& error);

/// A title, a caption or a line of a card.
void check_line(const char* key, std::string_view text, SceneProblems& problems);

/// Problems with "fade", "card", "seconds" and "compare" of a segment; its scenes have their own
/// problems_of().
std::vector<Problem> problems_of(const Segment& segment, bool is_first);

}  // namespace piblocks
