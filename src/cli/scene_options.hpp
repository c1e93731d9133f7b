// Options that describe a scene, shared by several commands; what a video is for, in one word.
// In: the command line. Out: a valid scene or storyboard, and the log of its collisions.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/script.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.hpp"
#include "core/overwrite_check.hpp"

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

/// Refers to options of the command it was made for, and is valid as long as they are.
class SceneOptions {
 public:
  /// Adds [SCENE], --digits, --base and --mass-ratio.
  explicit SceneOptions(const Command& command);
  void add_size();
  /// Adds --size, --transparent and --opaque.
  void add_picture();
  /// Adds --theme, --show, --panels and what else says what a picture shows.
  void add_show();
  /// Adds --shutter, and --fps and --speed, which it depends on.
  void add_exposure();
  /// Adds --from and --to.
  void add_span();
  /// Adds --from, --to and what else says how time runs in the video.
  void add_timing();
  void add_sound();

  /// @throws SceneError, UsageError; also if the file is a storyboard.
  Scene scene() const;
  /// @param defaults  win over the scene file, but not over options.
  /// @param origin    of these, named in messages.
  /// @throws SceneError, UsageError
  Script script(const std::vector<SceneDefault>& defaults = {},
                const std::string& origin = {}) const;
  /// Adds the scene file, and the logos of what was made of it.
  void add_inputs(OverwriteCheck& check, const Script& script) const;
  /// @throws UsageError if --output names the scene file or a logo of the script.
  void check_output(const Script& script = {}) const;

 private:
  /// An option that sets a key of the scene file to its text, or to a fixed one.
  struct Key {
    std::string key;
    std::string option;
    std::optional<std::string> value = {};
  };

  void add_key(const std::string& key, const std::string& option, const std::string& placeholder,
               const std::string& help);
  void add_flag(const Key& flag, const std::string& help);
  /// @throws UsageError if both options are given; `what` they set.
  void refuse_both(const std::string& first, const std::string& second, const char* what) const;

  Command command_;
  std::vector<Key> keys_;
};

/// Adds --engine.
void add_engine(Command& command);

/// The system's log, made by the engine that --engine names.
/// @throws UsageError if that engine would have to store too many collisions.
std::unique_ptr<CollisionLog> make_log(const BlockSystem& system, const Command& command);

/// Enters the logos of a scene or storyboard as files that are read.
void claim_logos(OverwriteCheck& check, const Script& script);

/// Says on standard error which of two equally good counts is shown, if all collisions of a run
/// happen at once: their number then depends on a convention.
/// @throws SceneError if problems_of() of the system is not empty.
void note_convention(const Script& script);

}  // namespace piblocks::cli
