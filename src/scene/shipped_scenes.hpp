// The scenes that come with the program, which need no file.
// In: a scene as the command line names it. Out: its text, read into a script.
#pragma once

#include <piblocks/script.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/overwrite_check.hpp"

namespace piblocks {

struct ShippedScene {
  std::string_view name;  ///< of its file, without ".toml"
  std::string_view text;  ///< of its file; the first line is a comment that says what it shows

  std::string_view summary() const;
};

/// Sorted by name.
std::span<const ShippedScene> shipped_scenes();
std::vector<std::string> shipped_scene_names();

/// Compares names only. @throws UsageError if there is none of this name.
const ShippedScene& find_shipped_scene(const std::string& name);

/// Reads a scene file or, if there is none at this path, the shipped scene of this name.
/// @throws SceneError if there is neither, or as ScriptBuilder::read_file().
void read_scene(ScriptBuilder& builder, const std::string& scene);

/// Enters the scene as a file that is read, unless it is a shipped one.
void claim_scene(OverwriteCheck& check, const std::string& scene);

}  // namespace piblocks
