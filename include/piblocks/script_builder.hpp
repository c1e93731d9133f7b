// A scene or a storyboard from a file and from options of the same keys.
// In: a scene file (TOML), keys with their text. Out: one valid script, or every problem at once.
#pragma once

#include <piblocks/storyboard.hpp>

#include <memory>
#include <string>

namespace piblocks {

/// Longest scene file that is read.
inline constexpr std::size_t kMaxSceneFile_bytes = 1 << 20;
/// Deepest lists and tables in it.
inline constexpr int kMaxSceneNesting = 256;

/// Collects values from a file and from options, and remembers where each came from.
///
/// The keys of a scene are "digits" or "mass-ratio", which set red.mass; "wall.face"; "blue." and
/// "red." with "mass", "position", "velocity", "width" ("by-mass" for red: width_by_mass());
/// "view.x", "view.y", "view.size", "view.fps", "view.shutter", "view.background", "view.theme";
/// "time.from", "time.to", "time.speed", "time.duration", "time.slow-motion", "time.freeze",
/// "time.hold-start", "time.hold-end", "time.loop"; "show.overlays", "show.panels", "show.title",
/// "show.caption", "show.logo"; "sound.on"; "golden.frames", "golden.size".
///
/// A file with [[part]] is a storyboard: its other keys hold for all parts. A part takes the keys
/// of a scene but those of the whole film, and beside them "card" and "seconds", "compare", "fade".
class ScriptBuilder {
 public:
  ScriptBuilder();
  ~ScriptBuilder();
  ScriptBuilder(const ScriptBuilder&) = delete;
  ScriptBuilder& operator=(const ScriptBuilder&) = delete;

  /// Reads a scene file; called once. Values set before it are overwritten, values set after it
  /// win.
  /// @throws SceneError if it cannot be read or is no TOML; other problems wait for build().
  void read_file(const std::string& path);
  /// Sets one key from text, as an option of the command line does. A storyboard takes keys of the
  /// whole film only, whether it is read before or after.
  /// @param origin  named in messages, such as "--size".
  void set(const std::string& origin, const std::string& key, const std::string& text);

  /// @throws SceneError with every problem: origin, key, value and reason.
  Script build() const;
  /// As build(), for those who want one scene. @throws SceneError if the file is a storyboard
  Scene build_scene() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace piblocks
