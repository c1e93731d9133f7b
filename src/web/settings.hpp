// What the page sets over the text of a scene file.
// In: lines. Out: a builder that has read the text and them.
#pragma once

#include <piblocks/script.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace piblocks::web {

/// What the picture does without.
struct LeftOut {
  std::string key;
  std::string item = {};    ///< of the key's list; empty if all of the key is left out
  std::string reason = {};  ///< in words for it alone: "needs elastic collisions"
  std::size_t part = 0;     ///< line of the [[part]] that has the key; 0 for none
};

/// A line of settings.
struct Setting {
  std::string key;
  std::optional<std::vector<std::string>> texts;  ///< nothing: the key has its default
};

/// Lines KEY=TEXT, in which the texts of a list are separated by tabs; or KEY, which gives a key
/// its default, whatever text and lines before say. @throws UsageError
std::vector<Setting> settings_of(std::string_view lines);

/// Reads the text and, over it, the settings. If the wall has a finite mass, blue, red and wall
/// are bodies 1, 2 and 3. @throws SceneError if it is too long, or no TOML.
std::unique_ptr<ScriptBuilder> builder_of(std::string_view text,
                                          const std::vector<Setting>& settings,
                                          const std::vector<LeftOut>& left_out);

}  // namespace piblocks::web
