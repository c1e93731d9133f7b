// Options that describe a scene, shared by the subcommands.
// In: the command line. Out: a valid scene.
#pragma once

#include <CLI/CLI.hpp>
#include <piblocks/collision_log.hpp>
#include <piblocks/error.hpp>
#include <piblocks/scene.hpp>

#include <memory>
#include <string>
#include <vector>

namespace piblocks::cli {

/// Must stay where it is while the App it was added to is in use.
class SceneOptions {
 public:
  /// [SCENE.toml], --digits, --mass-ratio.
  void add_system(CLI::App& command);
  /// --size.
  void add_size(CLI::App& command);
  /// --fps, --from, --to, --speed.
  void add_timing(CLI::App& command);

  /// @throws SceneError, UsageError
  Scene scene() const;

 private:
  void add_key(CLI::App& command, const std::string& option, const std::string& key,
               const std::string& help);

  struct KeyOption {
    std::string option;
    std::string key;
    std::string text;
    bool given = false;
  };

  std::string file_;
  std::string digits_;
  std::string mass_ratio_;
  std::vector<std::unique_ptr<KeyOption>> keys_;  // addresses are held by the App
};

/// --engine for the commands that offer both.
void add_engine(CLI::App& command, Engine& engine);

/// `text` read by `parse`; a failure names the option and the text.
template <typename Parse>
auto parse_option(const std::string& option, const std::string& text, const Parse& parse) {
  try {
    return parse(text);
  } catch (const UsageError& error) {
    throw UsageError(option + " " + text + ": " + error.what());
  }
}

}  // namespace piblocks::cli
