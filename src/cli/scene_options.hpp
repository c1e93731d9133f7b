// Options that describe a scene, shared by several commands.
// In: the command line. Out: a valid scene or storyboard, and the log of its collisions.
#pragma once

#include <piblocks/script.hpp>

#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/render_job.hpp"
#include "cli/script_facts.hpp"
#include "core/overwrite_check.hpp"
#include "scene/run_log.hpp"

namespace piblocks::cli {

/// Refers to options of the command it was made for, and is valid as long as they are.
class SceneOptions {
 public:
  /// Adds [SCENE], --digits, --base, --mass-ratio and --restitution.
  explicit SceneOptions(Command command);
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

  /// Whether a scene is named: a file, a shipped one, or standard input.
  bool has_scene() const;
  /// @throws SceneError, UsageError; also if the file is a storyboard.
  Scene scene() const;
  /// @param defaults  win over the scene file, but not over options.
  /// @param origin    of these, named in messages.
  /// @throws SceneError, UsageError
  Script script(const std::vector<SceneDefault>& defaults = {},
                const std::string& origin = {}) const;
  /// Adds the scene file, and the logos of what was made of it.
  void add_inputs(OverwriteCheck& check, const Script& script) const;
  /// @param check  has the other files that the command reads.
  /// @throws UsageError if --output names one of these, the scene file or a logo of the script.
  void check_output(const Script& script = {}, OverwriteCheck check = {}) const;

 private:
  /// An option that sets a key of the scene file to its text, or to a fixed one.
  struct Key {
    std::string key;
    std::string option;
    std::optional<std::string> value = {};
  };

  void add_key(const std::string& key, const std::string& option, const std::string& placeholder,
               const std::string& help);
  /// The same for a value that may be empty.
  void add_text(const std::string& key, const std::string& option, const std::string& placeholder,
                const std::string& help);
  void add_flag(const Key& flag, const std::string& help);

  Command command_;
  std::vector<Key> keys_;
};

/// Adds --engine.
void add_engine(Command& command);

/// Each as a line on standard error.
void note_all(const std::vector<std::string>& notes);
/// Says on standard error which of two equally good counts is shown, if all collisions of a run
/// happen at once: their number then depends on a convention.
/// @throws SceneError if problems_of() of the system is not empty.
void note_convention(const Script& script);
/// The same, and which own colours are hard to see.
void note_convention_and_contrast(const Script& script);
/// Says that a picture without motion blur is asked for with it.
void note_sharp(const Script& script);
/// Prints a note on standard error if the order of pairs decided what happened up to this
/// collision.
void note_ties(const Log& log, const Integer& last);

}  // namespace piblocks::cli
