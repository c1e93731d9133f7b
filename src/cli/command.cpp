#include "cli/command.hpp"

#include <CLI/CLI.hpp>

#include <utility>

#include "cli/app.hpp"

namespace piblocks::cli {
namespace {

constexpr int kAnyNumber = -1;

}  // namespace

Command Command::add_command(const std::string& name, const std::string& help) {
  return Command(*app_->add_subcommand(name, help));
}

void Command::add_flag(const std::string& name, const std::string& help) {
  app_->add_flag(name)->description(help);
}

void Command::add_value(const std::string& name, const std::string& placeholder,
                        const std::string& help) {
  app_->add_option(name, help)->option_text(placeholder);
}

void Command::add_required_value(const std::string& name, const std::string& placeholder,
                                 const std::string& help) {
  app_->add_option(name, help)->option_text(placeholder)->required();
}

void Command::add_values(const std::string& name, const std::string& placeholder,
                         const std::string& help) {
  CLI::Option* const option = app_->add_option(name, help)->option_text(placeholder);
  option->allow_extra_args(false)->expected(1, kAnyNumber);
}

void Command::add_argument(const std::string& name, const std::string& help) {
  app_->add_option(name, help)->required()->option_text(kNoText);
}

void Command::add_optional_argument(const std::string& name, const std::string& help) {
  app_->add_option(name, help)->option_text("");
}

void Command::add_arguments(const std::string& name, const std::string& help) {
  CLI::Option* const option = app_->add_option(name, help)->required()->option_text("...");
  option->expected(1, kAnyNumber)->allow_extra_args();
}

void Command::set_footer(const std::string& text) { app_->footer(text); }

void Command::require_command() { app_->require_subcommand(1); }

void Command::on_run(std::function<void()> run) { app_->callback(std::move(run)); }

std::string Command::name() const { return app_->get_name(); }

bool Command::is_given(const std::string& option) const {
  const CLI::Option* const found = app_->get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

std::optional<std::string> Command::text(const std::string& option) const {
  if (app_->get_option(option)->count() == 0) return std::nullopt;
  return texts(option).front();
}

std::vector<std::string> Command::texts(const std::string& option) const {
  return app_->get_option(option)->results();
}

}  // namespace piblocks::cli
