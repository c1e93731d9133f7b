#include "cli/app.hpp"

#include <fmt/format.h>
#include <piblocks/version.hpp>

#include "cli/commands.hpp"

namespace piblocks::cli {
namespace {

std::string shortest_name(const CLI::Option& option) {
  return option.get_snames().empty() ? option.get_name() : "-" + option.get_snames().front();
}

/// CLI11's form, but for short descriptions and a usage line that shows what has to be given.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(24); }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string usage = "Usage: " + name;
    if (app->get_require_subcommand_min() > 0) return usage + " COMMAND [OPTIONS]\n";
    for (const CLI::Option* option : app->get_options()) {
      if (option->get_required()) {
        usage += " " + shortest_name(*option);
        if (option->get_option_text() != kNoText) usage += " " + option->get_option_text();
      } else if (option->get_positional()) {
        usage += " [" + option->get_name() + "]";
      }
    }
    return usage + " [OPTIONS]\n";
  }

  std::string make_description(const CLI::App* app) const override {
    return app->get_description() + "\n\n";
  }
};

}  // namespace

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
