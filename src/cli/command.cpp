#include "cli/command.hpp"

#include <CLI/CLI.hpp>

#include <utility>

#include "cli/help_formatter.hpp"

namespace piblocks::cli {
namespace {

constexpr int kAnyNumber = -1;

}  // namespace

bool Option::is_given() const { return option_->count() > 0; }

std::string Option::name() const { return option_->get_name(); }

std::optional<std::string> Option::text() const {
  if (!is_given()) return std::nullopt;
  return option_->results().front();
}

std::vector<std::string> Option::texts() const { return option_->results(); }

Command Command::add_command(const std::string& name, const std::string& help) {
  return Command(*app_->add_subcommand(name, help));
}

Option Command::add_flag(const std::string& name, const std::string& help) {
  return Option(*app_->add_flag(name)->description(help));
}

Option Command::add_value(const std::string& name, const std::string& placeholder,
                          const std::string& help) {
  return Option(*app_->add_option(name, help)->option_text(placeholder));
}

Option Command::add_required_value(const std::string& name, const std::string& placeholder,
                                   const std::string& help) {
  return Option(*app_->add_option(name, help)->option_text(placeholder)->required());
}

Option Command::add_values(const std::string& name, const std::string& placeholder,
                           const std::string& help) {
  CLI::Option* const option = app_->add_option(name, help)->option_text(placeholder);
  return Option(*option->allow_extra_args(false)->expected(1, kAnyNumber));
}

Option Command::add_argument(const std::string& name, const std::string& help) {
  return Option(*app_->add_option(name, help)->required()->option_text(kNoText));
}

Option Command::add_optional_argument(const std::string& name, const std::string& help) {
  return Option(*app_->add_option(name, help)->option_text(""));
}

Option Command::add_arguments(const std::string& name, const std::string& help) {
  CLI::Option* const option = app_->add_option(name, help)->required()->option_text("...");
  return Option(*option->expected(1, kAnyNumber)->allow_extra_args());
}

void Command::set_footer(const std::string& text) { app_->footer(text); }

void Command::require_command() { app_->require_subcommand(1); }

void Command::on_run(std::function<void()> run) { app_->callback(std::move(run)); }

std::string Command::name() const { return app_->get_name(); }

bool Command::is_given(const std::string& option) const {
  const CLI::Option* const found = app_->get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

}  // namespace piblocks::cli
