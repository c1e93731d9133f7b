// Options that describe a scene, shared by the subcommands.
// In: the command line. Out: a valid scene or storyboard, and the log of its collisions.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/script.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "core/overwrite_check.hpp"

namespace piblocks::cli {

/// The value of a key of the scene file.
struct SceneDefault {
  std::string key;
  std::string text;
};

/// Refers to options of the command it was made for, and is valid as long as they are.
class SceneOptions {
 public:
  /// Adds [SCENE.toml], --digits and --mass-ratio.
  explicit SceneOptions(Command& command);
  /// Adds --size.
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

  /// Adds --sound and --no-sound.
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
  /// @throws UsageError if the option names the scene file as the output.
  void refuse_as_output(const Option& output) const;
  /// @throws UsageError if the option names the scene file or a logo as the output.
  void refuse_as_output(const Option& output, const Script& script) const;
  /// @throws UsageError if it names the sound alone, and there is to be none.
  void refuse_silence(const Option& output) const;

 private:
  /// Adds an option that sets a key of the scene file.
  void add_key(const std::string& key, const std::string& option, const std::string& placeholder,
               const std::string& help);
  /// Adds an option without a value that sets a key of the scene file to this one.
  void add_flag(const std::string& key, const std::string& value, const std::string& option,
                const std::string& help);
  void add_pacing();
  /// @throws UsageError if both options are given; `what` they set.
  void refuse_both(const std::string& first, const std::string& second, const char* what) const;

  Command command_;
  Option file_;
  std::vector<std::pair<std::string, Option>> keys_;
  struct Flag {
    std::string key;
    std::string value;
    Option option;
  };
  std::vector<Flag> flags_;
};

/// Adds --engine, for the commands that offer both engines.
Option add_engine(Command& command);

/// The system's log, made by the engine that the option names.
/// @throws UsageError if that engine would have to store too many collisions.
std::unique_ptr<CollisionLog> make_log(const BlockSystem& system, const Option& engine);

}  // namespace piblocks::cli
