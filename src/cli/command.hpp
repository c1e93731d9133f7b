// The commands of the program: their options, their values on the command line, their exit codes.
// In: names and help texts; later the arguments of main(). Out: the command that they name has run.
// CLI11 is behind this, for tables of options and for help: it costs a compiler seconds wherever it
// is included.
#pragma once

#include <piblocks/error.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/option_texts.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): CLI11 is called so
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace piblocks::cli {

struct Program;

// Exit codes; 0 is done. The last four are those of comparisons.
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kDifferent = 1;
inline constexpr int kMissingReference = 3;
inline constexpr int kMismatch = 4;
inline constexpr int kUnreadable = 5;

/// Ends the program with an exit code that says more than done, failed or wrong usage.
class ExitError : public Error {
 public:
  /// @param message  for standard error; empty if all has been said.
  explicit ExitError(int code, const std::string& message = {}) : Error(message), code_(code) {}
  int code() const noexcept { return code_; }

 private:
  int code_;
};

/// Refers to a command, and is valid as long as the program's command line. An option is named as
/// in messages: "--output", or "SCENE" for an argument without a name.
class Command final : public OptionTexts {
 public:
  Command(Program& program, CLI::App& app) : program_(&program), app_(&app) {}

  /// A command below this one.
  Command add_command(const std::string& name, const std::string& help);
  /// An option without a value.
  void add_flag(const std::string& name, const std::string& help);
  /// @param placeholder  stands for the value in the help, as in "--size WxH".
  void add_value(const std::string& name, const std::string& placeholder, const std::string& help);
  /// A value that may be empty: a text, or a list of any length.
  void add_text(const std::string& name, const std::string& placeholder, const std::string& help);
  void add_required_value(const std::string& name, const std::string& placeholder,
                          const std::string& help);
  /// A value that may be given several times.
  void add_values(const std::string& name, const std::string& placeholder, const std::string& help);
  /// A text that stands behind the command without a name.
  void add_argument(const std::string& name, const std::string& help);
  void add_optional_argument(const std::string& name, const std::string& help);
  /// One or more of them.
  void add_arguments(const std::string& name, const std::string& help);

  /// Text below the help.
  void set_footer(const std::string& text);
  /// Makes one of the commands below it necessary.
  void require_command();
  void on_run(std::function<void()> run);

  std::string name() const;
  bool is_given(const std::string& option) const override;
  std::optional<std::string> text(const std::string& option) const override;
  std::vector<std::string> texts(const std::string& option) const override;

 private:
  Program* program_;
  CLI::App* app_;
};

/// The name that --output gives; "-" if it is not given.
std::string output_of(const Command& command);
/// @throws UsageError if the output is "-" and standard output is a terminal.
void refuse_terminal(const Command& command);

/// Runs the command that the arguments of main() name.
/// @returns the exit code. @throws what commands throw
int run_command_line(int argc, char** argv);

// Each gives a command its options, and says what it does.
void define_render(Command& command);
void define_join(Command& command);
void define_still(Command& command);
void define_sheet(Command& command);
void define_page(Command& command);
void define_log(Command& command);
void define_state(Command& command);
void define_count(Command& command);
void define_min_restitution(Command& command);
void define_scenes(Command& command);
void define_compare(Command& command);
void define_golden(Command& command);
void define_info(Command& command);
void define_manual(Command& command);

}  // namespace piblocks::cli
