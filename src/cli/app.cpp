#include "cli/app.hpp"

#include <CLI/CLI.hpp>
#include <unistd.h>

#include <array>
#include <utility>

#include "cli/command.hpp"

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

constexpr int kAnyNumber = -1;

struct NamedCommand {
  const char* name;
  const char* help;
  void (*define)(Command& command);
};

constexpr auto kCommands = std::to_array<NamedCommand>({
    {"render", "Render a video or a sequence of frames", define_render},
    {"join", "Join the parts of a rendering", define_join},
    {"still", "Render one instant as a picture", define_still},
    {"sheet", "Render several instants on one page, for paper", define_sheet},
    {"page", "Write the live page, which runs this program in a browser", define_page},
    {"log", "Print every collision, a row each", define_log},
    {"state", "Print positions, velocities and count, one JSON object a line", define_state},
    {"count", "Print the total number of collisions", define_count},
    {"min-restitution", "Print how elastic real blocks must be to count digits of pi",
     define_min_restitution},
    {"scenes", "List the scenes that come with the program", define_scenes},
    {"compare", "Compare pictures, sequences or videos", define_compare},
    {"golden", "Hold scenes and pictures to references: record, check, approve", define_golden},
    {"info", "Print versions of the libraries, encoders found, limits", define_info},
    {"manual", "Print the manual page, or what a shell needs to complete options", define_manual},
});

void add_version(CLI::App& command) {
  command.add_flag("--version")->description("Print the version and exit");
}

}  // namespace

std::unique_ptr<Program> make_program() {
  auto made = std::make_unique<Program>();
  CLI::App& app = made->app;
  app.name("piblocks");
  app.description(
      "Renders two sliding blocks and a wall whose collisions count the digits of pi.\n\n"
      "Example: piblocks render --digits 3 -o pi-3.mp4");
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "Print this text and exit");
  app.require_subcommand(1);
  add_version(app);
  for (const auto& [name, help, define] : kCommands) {
    CLI::App& command = *app.add_subcommand(name, help);
    command.group("Commands");
    made->definitions[&command] = define;
  }
  app.get_formatter()->label("Positionals", "Arguments");
  app.footer(
      "'piblocks COMMAND --help' or 'piblocks help COMMAND' explains a command.\n"
      "Exit codes: 0 done, 1 failed, 2 wrong usage.");
  return made;
}

void define(Program& program, CLI::App& app) {
  auto definition = program.definitions.extract(&app);
  if (definition.empty()) return;
  Command command(program, app);
  definition.mapped()(command);
  add_version(app);
}

void define_all(Program& program) {
  for (CLI::App* command : program.app.get_subcommands({})) define(program, *command);
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  return names;
}

std::string full_name(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  if (parent == nullptr) return {};
  const std::string before = full_name(*parent);
  return before.empty() ? command.get_name() : before + ' ' + command.get_name();
}

Command Command::add_command(const std::string& name, const std::string& help) {
  return {*program_, *app_->add_subcommand(name, help)};
}

void Command::add_flag(const std::string& name, const std::string& help) {
  app_->add_flag(name)->description(help);
}

void Command::add_value(const std::string& name, const std::string& placeholder,
                        const std::string& help) {
  app_->add_option(name, help)->option_text(placeholder);
}

void Command::add_text(const std::string& name, const std::string& placeholder,
                       const std::string& help) {
  add_value(name, placeholder, help);
  program_->texts.insert(app_->get_option(name));
}

void Command::add_required_value(const std::string& name, const std::string& placeholder,
                                 const std::string& help) {
  app_->add_option(name, help)->option_text(placeholder)->required();
}

void Command::add_values(const std::string& name, const std::string& placeholder,
                         const std::string& help) {
  app_->add_option(name, help)->option_text(placeholder)->expected(1, kAnyNumber);
}

void Command::add_argument(const std::string& name, const std::string& help) {
  app_->add_option(name, help)->required()->option_text(kNoText);
}

void Command::add_optional_argument(const std::string& name, const std::string& help) {
  app_->add_option(name, help)->option_text("");
}

void Command::add_arguments(const std::string& name, const std::string& help) {
  app_->add_option(name, help)->required()->option_text("...")->expected(1, kAnyNumber);
}

void Command::set_footer(const std::string& text) { app_->footer(text); }

void Command::require_command() { app_->require_subcommand(1); }

void Command::on_run(std::function<void()> run) { program_->runs[app_] = std::move(run); }

std::string Command::name() const { return app_->get_name(); }

bool Command::is_given(const std::string& option) const {
  return program_->values.contains(app_->get_option_no_throw(option));
}

std::optional<std::string> Command::text(const std::string& option) const {
  const std::vector<std::string> given = texts(option);
  return given.empty() ? std::nullopt : std::optional(given.front());
}

std::vector<std::string> Command::texts(const std::string& option) const {
  const auto given = program_->values.find(app_->get_option(option));
  return given == program_->values.end() ? std::vector<std::string>() : given->second;
}

std::string output_of(const Command& command) { return command.text("--output").value_or("-"); }

void refuse_terminal(const Command& command) {
  if (output_of(command) != "-" || isatty(STDOUT_FILENO) == 0) return;
  throw UsageError("--output -: standard output is a terminal; pipe it or redirect it to a file");
}

}  // namespace piblocks::cli
