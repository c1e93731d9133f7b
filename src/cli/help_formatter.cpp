#include "cli/help_formatter.hpp"

namespace piblocks::cli {
namespace {

std::string shortest_name(const CLI::Option& option) {
  return option.get_snames().empty() ? option.get_name() : "-" + option.get_snames().front();
}

}  // namespace

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
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

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return app->get_description() + "\n\n";
}

}  // namespace piblocks::cli
