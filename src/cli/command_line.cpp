#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/app.hpp"
#include "cli/command.hpp"
#include "cli/nearest_name.hpp"
#include "core/output_file.hpp"

namespace piblocks::cli {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  return names;
}

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

/// @param extras  arguments that no command takes.
std::string without_command(const CLI::App& app, const std::vector<std::string>& extras) {
  const std::string name = full_name(app);
  const std::string who = name.empty() ? name : name + ": ";
  const std::string advice =
      fmt::format("use one of {}; {}", fmt::join(command_names(app), ", "), help_of(app));
  if (extras.empty()) return fmt::format("{}no command: {}", who, advice);
  const std::string& extra = extras.front();
  const bool is_option = extra.starts_with('-');
  const std::string near = nearest_name(extra, is_option ? option_names(app) : command_names(app));
  return fmt::format("{}unknown {} '{}'{} {}", who, is_option ? "option" : "command", extra,
                     near.empty() ? ":" : did_you_mean(near), advice);
}

std::string about_extra(const CLI::App& command, const std::string& extra) {
  const bool is_option = extra.starts_with('-') && extra.size() > 1;
  if (!is_option) {
    return fmt::format("{}: unexpected argument '{}'; {}", full_name(command), extra,
                       help_of(command));
  }
  const std::string near = nearest_name(extra.substr(0, extra.find('=')), option_names(command));
  return fmt::format("{}: unknown option '{}'{} {}", full_name(command), extra,
                     near.empty() ? ";" : did_you_mean(near), help_of(command));
}

std::string about_missing(const CLI::App& command) {
  std::vector<std::string> missing;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    std::string name = option->get_name(false, true);
    if (option->get_option_text() != kNoText) name += ' ' + option->get_option_text();
    missing.push_back(std::move(name));
  }
  return fmt::format("{}: missing {}; {}", full_name(command), fmt::join(missing, " and "),
                     help_of(command));
}

/// An option without its value, or more than once. Only the exception's text knows which:
/// "--size: ..." (CLI11 2.1.2).
std::string about_count(const CLI::App& command, const std::string& text) {
  const std::string name = text.substr(0, text.find(':'));
  const CLI::Option* option = command.get_option_no_throw(name);
  if (option == nullptr) return text;
  if (option->count() > 0) return name + " is given more than once";
  return fmt::format("{} needs a value: {} {}", name, name, option->get_option_text());
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* last = &app;  // of the commands on the command line
  while (!last->get_subcommands().empty()) last = last->get_subcommands().front();
  const CLI::App& command = *last;
  const std::vector<std::string> extras = app.remaining(true);
  if (command.get_require_subcommand_min() > 0) return without_command(command, extras);
  if (error.get_name() == "ArgumentMismatch") return about_count(command, error.what());
  // A misspelt option is the likely reason why another one is missing.
  if (!extras.empty()) return about_extra(command, extras.front());
  if (error.get_name() == "RequiredError") return about_missing(command);
  return error.what();
}

bool names_command(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* named = &app;
  for (const std::string& word : words) {
    const std::vector<const CLI::App*> commands = commands_of(*named);
    const auto found = std::ranges::find(commands, word, &CLI::App::get_name);
    if (found == commands.end()) return false;
    named = *found;
  }
  return true;
}

/// "piblocks help COMMAND" is "piblocks COMMAND --help". CLI11 takes arguments from the back.
std::vector<std::string> arguments_of(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!arguments.empty() && arguments.front() == "help") {
    arguments.erase(arguments.begin());
    if (names_command(app, arguments)) arguments.emplace_back("--help");
  }
  std::ranges::reverse(arguments);
  return arguments;
}

/// Prints --help or --version.
void print(const CLI::App& app, const CLI::ParseError& request) {
  std::ostringstream text;
  app.exit(request, text, text);
  OutputFile out("-", OutputFile::Contents::text);
  out.write(text.str());
  out.finish();
}

}  // namespace

int run_command_line(int argc, char** argv) {
  const std::unique_ptr<CLI::App> app = make_app();
  if (argc <= 1) {
    std::fputs(app->help().c_str(), stderr);
    return kWrongUsage;
  }
  try {
    app->parse(arguments_of(*app, argc, argv));
  } catch (const CLI::ParseError& stop) {
    if (stop.get_exit_code() != 0) throw UsageError(usage_message(*app, stop));
    print(*app, stop);
  }
  return 0;
}

}  // namespace piblocks::cli
