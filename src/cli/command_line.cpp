#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>
#include <piblocks/version.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/app.hpp"
#include "cli/command.hpp"
#include "cli/text_output.hpp"
#include "core/nearest_name.hpp"

namespace piblocks::cli {
namespace {

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string help_of(const CLI::App& command) {
  const std::string name = full_name(command);
  return fmt::format("see 'piblocks {}--help'", name.empty() ? name : name + ' ');
}

/// "unknown option '--sise'; did you mean '--size'?"
/// @param what   an option or a command. @param names  the known ones.
std::string about_unknown(const char* what, const std::string& word,
                          const std::vector<std::string>& names) {
  return fmt::format("unknown {} '{}'{}", what, word,
                     did_you_mean(word.substr(0, word.find('=')), names));
}

/// @param unknown  what about_unknown() says, or that there is no command.
UsageError without_command(const CLI::App& app, const std::string& unknown) {
  const std::string name = full_name(app);
  return UsageError(fmt::format("{}{}{}{} use one of {}; {}", name, name.empty() ? "" : ": ",
                                unknown, unknown.ends_with('?') ? "" : ":",
                                fmt::join(command_names(app), ", "), help_of(app)));
}

/// The word with "--" instead of the dash into which editors turn it; empty if it begins with none.
std::string with_two_dashes(std::string_view word) {
  for (const std::string_view dash : {"\u2013", "\u2014", "\u2212"}) {
    if (word.starts_with(dash)) return "--" + std::string(word.substr(dash.size()));
  }
  return {};
}

/// A shell replaces the ~ in "-o ~/a.mp4", and leaves that of "--output=~/a.mp4" to the program.
bool begins_at_home(std::string_view value) { return value == "~" || value.starts_with("~/"); }

/// An option as it is written: "--size=64x36", "-oa.mp4", "-o=a.mp4" or without a value.
struct WrittenOption {
  std::string name;
  std::optional<std::string> value;

  explicit WrittenOption(const std::string& argument) : name(argument) {
    constexpr std::size_t kShort = 2;
    const bool is_long = argument.starts_with("--");
    const std::size_t end = is_long ? argument.find('=') : kShort;
    if (end >= argument.size()) return;
    name.resize(end);
    value = argument.substr(argument[end] == '=' ? end + 1 : end);
  }
};

/// Reads the arguments of main() by the rules of getopt_long(), without abbreviations: the value of
/// an option is the rest of its argument or else the next argument, even if it is empty.
class ArgumentReader {
 public:
  explicit ArgumentReader(Program& program) : program_(program), command_(&program.app) {}

  /// @throws UsageError for an unknown command; other problems wait, since help may be asked for.
  void read(const std::vector<std::string>& arguments) {
    for (rest_ = arguments; !rest_.empty();) {
      const std::string argument = next();
      if (!only_words_ && argument == "--") {
        only_words_ = true;
      } else if (!only_words_ && argument.size() > 1 && argument.front() == '-') {
        read_option(argument);
      } else if (const auto meant = with_two_dashes(argument); !only_words_ && !meant.empty()) {
        add_problem(fmt::format(
            "unknown option '{}', which begins with another character than '-'{}", argument,
            did_you_mean(meant.substr(0, meant.find('=')), option_names(*command_))));
      } else {
        read_word(argument);
      }
    }
  }

  /// @throws UsageError for the first problem.
  void check() const {
    if (!problem_.empty()) throw UsageError(problem_);
    if (command_->get_require_subcommand_min() > 0) throw without_command(*command_, "no command");
    std::vector<std::string> missing;
    for (const CLI::Option* option : command_->get_options()) {
      if (!option->get_required() || is_given(*option)) continue;
      std::string name = option->get_name(false, true);
      if (option->get_option_text() != kNoText) name += ' ' + option->get_option_text();
      missing.push_back(std::move(name));
    }
    if (missing.empty()) return;
    throw UsageError(fmt::format("{}: missing {}; {}", full_name(*command_),
                                 fmt::join(missing, " and "), help_of(*command_)));
  }

  /// The last one that was named.
  CLI::App& command() const { return *command_; }
  bool has(const char* flag) const {
    const CLI::Option* const option = command_->get_option_no_throw(flag);
    return option != nullptr && is_given(*option);
  }

 private:
  std::string next() {
    std::string argument = rest_.front();
    rest_ = rest_.subspan(1);
    return argument;
  }

  void add_problem(const std::string& problem) {
    if (problem_.empty()) problem_ = problem;
  }

  void read_word(const std::string& word) {
    if (command_->get_require_subcommand_min() > 0) {
      const auto is_named = [&](const CLI::App* command) { return command->get_name() == word; };
      const std::vector<CLI::App*> named = command_->get_subcommands(is_named);
      if (named.empty()) {
        if (!problem_.empty()) throw UsageError(problem_);
        throw without_command(*command_, about_unknown("command", word, command_names(*command_)));
      }
      command_ = named.front();
      define(program_, *command_);
      return;
    }
    for (const CLI::Option* option : command_->get_options()) {
      if (!option->get_positional() || !has_room(*option)) continue;
      if (word.empty()) {
        add_problem(fmt::format("{}: {} is empty", full_name(*command_), option->get_name()));
      }
      program_.values[option].push_back(word);
      return;
    }
    add_problem(fmt::format("{}: unexpected argument '{}'; {}", full_name(*command_), word,
                            help_of(*command_)));
  }

  void read_option(const std::string& argument) {
    const WrittenOption written(argument);
    const CLI::Option* const option = command_->get_option_no_throw(written.name);
    // "-output a.mp4" is not "-o utput".
    const std::string with_two = '-' + argument.substr(0, argument.find('='));
    const bool lacks_dash = command_->get_option_no_throw(with_two) != nullptr;
    if (option == nullptr || lacks_dash) return add_unknown(argument);
    const std::string name = option->get_name();
    if (!takes_value(*option)) {
      if (written.value) add_problem(fmt::format("'{}': {} takes no value", argument, name));
      program_.values[option] = {"true"};
    } else if (!has_room(*option)) {
      add_problem(name + " is given more than once");
    } else if (written.value) {
      add_value(*option, *written.value);
    } else if (rest_.empty()) {
      add_problem(fmt::format("{} needs a value: {} {}", name, name, option->get_option_text()));
    } else if (is_option(rest_.front())) {
      add_problem(
          fmt::format("{0} needs a value, and '{1}' follows; if that is the value, write "
                      "'{0}={1}'",
                      name, rest_.front()));
    } else {
      add_value(*option, next());
    }
  }

  void add_value(const CLI::Option& option, const std::string& value) {
    if (value.empty() && !program_.texts.contains(&option)) {
      const std::string name = option.get_name();
      add_problem(fmt::format("{} needs a value, and this one is empty: {} {}", name, name,
                              option.get_option_text()));
    }
    if (begins_at_home(value) && !program_.texts.contains(&option)) {
      add_problem(
          fmt::format("{0}: the shell has not replaced the ~ of '{1}'; write '{0} {1}' "
                      "without quotes, or './{1}' for a folder of this name",
                      option.get_name(), value));
    }
    program_.values[&option].push_back(value);
  }

  void add_unknown(const std::string& option) {
    const std::string unknown = about_unknown("option", option, option_names(*command_));
    if (command_->get_require_subcommand_min() > 0) {
      add_problem(without_command(*command_, unknown).what());
    } else {
      add_problem(fmt::format("{}: {}{} {}", full_name(*command_), unknown,
                              unknown.ends_with('?') ? "" : ";", help_of(*command_)));
    }
  }

  bool is_given(const CLI::Option& option) const { return program_.values.contains(&option); }
  bool has_room(const CLI::Option& option) const {
    return !is_given(option) || option.get_items_expected_max() > 1;
  }

  /// Whether an argument is an option, perhaps a misspelt one, rather than a value.
  bool is_option(const std::string& argument) const {
    return argument.starts_with("--") ||
           (argument.starts_with('-') && command_->get_option_no_throw(argument) != nullptr);
  }

  Program& program_;
  CLI::App* command_;
  std::span<const std::string> rest_;
  bool only_words_ = false;
  std::string problem_;  ///< the first one
};

/// "piblocks help COMMAND" becomes "piblocks COMMAND --help". It runs nothing: options are dropped.
std::vector<std::string> arguments_of(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.front() != "help") return arguments;
  arguments.erase(arguments.begin());
  std::erase_if(arguments, [](const std::string& argument) { return argument.starts_with('-'); });
  arguments.emplace_back("--help");
  return arguments;
}

std::string help_text(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  if (parent == nullptr) return command.help();
  const std::string above = full_name(*parent);
  return command.help(above.empty() ? "piblocks" : "piblocks " + above);
}

}  // namespace

int run_command_line(int argc, char** argv) {
  const std::unique_ptr<Program> program = make_program();
  if (argc <= 1) {
    std::fputs(program->app.help().c_str(), stderr);
    return kWrongUsage;
  }
  ArgumentReader reader(*program);
  reader.read(arguments_of(argc, argv));
  if (reader.has("--help")) {
    print_text(help_text(reader.command()));
  } else if (reader.has("--version")) {
    print_text(fmt::format("piblocks {}\n", kVersion));
  } else {
    reader.check();
    program->runs.at (&reader.command())();
  }
  return 0;
}

}  // namespace piblocks::cli
