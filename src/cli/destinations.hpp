// What a video is for, in one word.
// In: the name of a destination. Out: the settings that suit it, and the endings that it takes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/scene_options.hpp"

namespace piblocks::cli {

struct Destination {
  std::string_view name;
  /// Values of scene keys, instead of the defaults and of the scene file.
  std::vector<SceneDefault> defaults;
  std::vector<std::string_view> endings;
  /// Of *.mov, where it is not the usual one.
  std::optional<std::string> mov_encoder = {};
};

/// @throws UsageError with all the names if there is none of this one.
const Destination& parse_destination(const std::string& name);

/// @throws UsageError if the destination does not take files of this name.
void check_ending(const Destination& destination, const std::string& output);

/// The names, as a message lists them.
std::string destination_names();

}  // namespace piblocks::cli
