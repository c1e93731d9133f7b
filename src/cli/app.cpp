#include "cli/app.hpp"

#include <fmt/format.h>
#include <piblocks/version.hpp>

#include "cli/commands.hpp"
#include "cli/help_formatter.hpp"

namespace piblocks::cli {

std::unique_ptr<CLI::App> make_app() {
  auto app = std::make_unique<CLI::App>(
      "Renders two sliding blocks and a wall whose collisions count the digits of pi.\n\n"
      "Example: piblocks render --digits 3 -o pi-3.mp4",
      "piblocks");
  const std::string version = fmt::format("piblocks {}", kVersion);
  app->formatter(std::make_shared<HelpFormatter>());
  app->set_help_flag("-h,--help", "Print this text and exit");
  app->require_subcommand(1);
  Command program(*app);
  add_render(program);
  add_join(program);
  add_still(program);
  add_sheet(program);
  add_log(program);
  add_state(program);
  add_count(program);
  add_compare(program);
  add_golden(program);
  add_info(program);
  add_manual(program);
  app->set_version_flag("--version", version, "Print the version and exit");
  for (CLI::App* command : app->get_subcommands({})) {
    command->group("Commands");
    command->set_version_flag("--version", version, "Print the version and exit");
  }
  app->get_formatter()->label("Positionals", "Arguments");
  app->footer(
      "'piblocks COMMAND --help' or 'piblocks help COMMAND' explains a command.\n"
      "Exit codes: 0 done, 1 failed, 2 wrong usage.");
  return app;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string full_name(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  if (parent == nullptr) return {};
  const std::string before = full_name(*parent);
  return before.empty() ? command.get_name() : before + ' ' + command.get_name();
}

}  // namespace piblocks::cli
