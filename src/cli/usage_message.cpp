#include "cli/usage_message.hpp"

#include <fmt/format.h>

#include <vector>

namespace piblocks::cli {
namespace {

std::string command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string without_command(const CLI::App& app) {
  const std::vector<std::string> extras = app.remaining();
  const std::string advice =
      fmt::format("use one of {}; see 'piblocks --help'", command_names(app));
  if (extras.empty()) return "no command: " + advice;
  const char* what = extras.front().starts_with('-') ? "option" : "command";
  return fmt::format("unknown {} '{}': {}", what, extras.front(), advice);
}

std::string about_extra(const CLI::App& command, const std::string& extra) {
  const std::string& name = command.get_name();
  const char* what =
      extra.starts_with('-') && extra.size() > 1 ? "unknown option" : "unexpected argument";
  return fmt::format("{}: {} '{}'; see 'piblocks {} --help'", name, what, extra, name);
}

std::string about_missing(const CLI::App& command) {
  std::vector<std::string> missing;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    missing.push_back(
        fmt::format("{} {}", option->get_name(false, true), option->get_option_text()));
  }
  return fmt::format("{}: missing {}; see 'piblocks {} --help'", command.get_name(),
                     fmt::join(missing, " and "), command.get_name());
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

}  // namespace

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  if (app.get_subcommands().empty()) return without_command(app);
  const CLI::App& command = *app.get_subcommands().front();
  if (error.get_name() == "ArgumentMismatch") return about_count(command, error.what());
  // A misspelt option is the likely reason why another one is missing.
  if (const auto extras = command.remaining(); !extras.empty()) {
    return about_extra(command, extras.front());
  }
  if (const auto extras = app.remaining(); !extras.empty()) {
    return about_extra(command, extras.front());
  }
  if (error.get_name() == "RequiredError") return about_missing(command);
  return error.what();
}

}  // namespace piblocks::cli
