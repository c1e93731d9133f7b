// A command of the program and its options.
// In: names and help texts. Out: what the command line says, for the command that runs.
// CLI11 is behind this: it costs a compiler seconds wherever it is included.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

// NOLINTNEXTLINE(readability-identifier-naming): CLI11 is called so
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace piblocks::cli {

/// Refers to an option of a Command, and is valid as long as the program's command line.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  bool is_given() const;
  std::string name() const;
  /// The value's text; nothing if the option was not given.
  std::optional<std::string> text() const;
  /// Of an option that may be given several times.
  std::vector<std::string> texts() const;

 private:
  CLI::Option* option_;
};

/// Refers to a command, and is valid as long as the program's command line.
/// CLI11 only collects texts: what it says of a text that it cannot convert is not for users.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  /// A command below this one.
  Command add_command(const std::string& name, const std::string& help);
  /// An option without a value.
  Option add_flag(const std::string& name, const std::string& help);
  /// @param placeholder  what stands for the value in the help, as in "--size WxH".
  Option add_value(const std::string& name, const std::string& placeholder,
                   const std::string& help);
  Option add_required_value(const std::string& name, const std::string& placeholder,
                            const std::string& help);
  /// A value that may be given several times.
  Option add_values(const std::string& name, const std::string& placeholder,
                    const std::string& help);
  /// What stands behind the command without a name.
  Option add_argument(const std::string& name, const std::string& help);
  Option add_optional_argument(const std::string& name, const std::string& help);
  /// One or more of them.
  Option add_arguments(const std::string& name, const std::string& help);

  /// Text below the help.
  void set_footer(const std::string& text);
  /// Makes one of the commands below it necessary.
  void require_command();
  void on_run(std::function<void()> run);

  std::string name() const;
  /// Whether it has this option and the option is given.
  bool is_given(const std::string& option) const;

 private:
  CLI::App* app_;
};

}  // namespace piblocks::cli
