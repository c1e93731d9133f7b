// What a video is for, in one word.
// In: the name of a use. Out: the settings that suit it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace piblocks::cli {

/// The value of a key of the scene file.
struct SceneDefault {
  std::string key;
  std::string text;
};

/// What --for names: the settings that suit a use of the video.
struct Destination {
  std::string_view name;
  /// They win over the scene file.
  std::vector<SceneDefault> defaults;
  std::vector<std::string_view> endings;  ///< of the files that it takes
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
