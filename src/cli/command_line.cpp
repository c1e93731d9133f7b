#include "cli/command_line.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "cli/app.hpp"
#include "cli/exit_code.hpp"
#include "cli/usage_message.hpp"
#include "core/output_file.hpp"

namespace piblocks::cli {
namespace {

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
