// A command of the program, its options, and what the command line says of them.
// In: names and help texts; later the command line. Out: the options' texts and values, by name.
// CLI11 is behind this: it costs a compiler seconds wherever it is included.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>

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

/// Refers to a command, and is valid as long as the program's command line. An option is named as
/// in messages: "--output", or "SCENE" for an argument without a name.
/// CLI11 only collects texts: users never see its errors about conversion.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  /// A command below this one.
  Command add_command(const std::string& name, const std::string& help);
  /// An option without a value.
  void add_flag(const std::string& name, const std::string& help);
  /// @param placeholder  stands for the value in the help, as in "--size WxH".
  void add_value(const std::string& name, const std::string& placeholder, const std::string& help);
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
  /// False also if the command has no such option.
  bool is_given(const std::string& option) const;
  /// Nothing if the option was not given.
  std::optional<std::string> text(const std::string& option) const;
  /// Of an option that may be given several times.
  std::vector<std::string> texts(const std::string& option) const;
  /// The option's value as `parse` makes it of the text; nothing if it was not given.
  /// @throws UsageError that names option and text if `parse` throws one
  template <typename Parse>
  auto value(const std::string& option, const Parse& parse) const
      -> std::optional<decltype(parse(std::string()))> {
    const std::optional<std::string> given = text(option);
    if (!given) return std::nullopt;
    try {
      return parse(*given);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{} {}: {}", option, *given, error.what()));
    }
  }

 private:
  CLI::App* app_;
};

}  // namespace piblocks::cli
