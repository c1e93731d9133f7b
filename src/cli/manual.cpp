#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/scene.hpp>
#include <piblocks/version.hpp>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/app.hpp"
#include "cli/command.hpp"
#include "cli/text_output.hpp"
#include "scene/shipped_scenes.hpp"

namespace piblocks::cli {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// A description as one line.
std::string flat(const std::string& text) { return replaced(text, "\n", " "); }

std::string shell_quoted(const std::string& text) {
  return "'" + replaced(text, "'", "'\\''") + "'";
}

/// The commands that do something: "golden check", not "golden".
std::vector<const CLI::App*> leaves_of(const CLI::App& app) {
  const std::vector<const CLI::App*> commands = commands_of(app);
  if (commands.empty()) return {&app};
  std::vector<const CLI::App*> leaves;
  for (const CLI::App* command : commands) {
    for (const CLI::App* leaf : leaves_of(*command)) leaves.push_back(leaf);
  }
  return leaves;
}

/// The names of its commands, with blanks; empty if it has none.
std::string names_below(const CLI::App& app) {
  return fmt::format("{}", fmt::join(command_names(app), " "));
}

struct NamedOption {
  const CLI::Option* option;
  std::string name;  ///< without "--"
};

std::vector<NamedOption> named_options_of(const CLI::App& command) {
  std::vector<NamedOption> named;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) named.push_back({option, name});
  }
  return named;
}

/// Options that take words, and these words, with commas.
constexpr auto kWordOptions = std::to_array<std::pair<const char*, std::string (*)()>>(
    {{"--theme", theme_names}, {"--show", overlay_names}, {"--panels", panel_names}});

/// The words that an option takes; empty for numbers, names of files and the like.
std::string words_of(const CLI::Option& option) {
  for (const auto& [name, words] : kWordOptions) {
    if (option.get_name() == name) return replaced(words(), ",", "");
  }
  return {};
}

/// Whether the command takes a scene, as a file or by its name.
bool takes_scene(const CLI::App& command) {
  return command.get_option_no_throw("SCENE") != nullptr;
}

std::string shipped_names() { return fmt::format("{}", fmt::join(shipped_scene_names(), " ")); }

/// Text in roff: no line begins with a control character, and hyphens can be searched for.
std::string roff(const std::string& text) {
  std::string escaped = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  escaped = replaced(escaped, "\n.", "\n\\&.");
  return replaced(escaped, "\n'", "\n\\&'");
}

std::string roff_of(const CLI::Option& option) {
  const std::string name =
      option.get_positional() ? option.get_name() : option.get_name(false, true);
  const std::string value =
      takes_value(option) ? " \\fI" + roff(option.get_option_text()) + "\\fR" : "";
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(replaced(name, ",", ", ")), value,
                     roff(option.get_description()));
}

std::string roff_of(const CLI::App& command) {
  std::string text = fmt::format(".SS piblocks {}\n{}.\n", roff(full_name(command)),
                                 roff(command.get_description()));
  for (const CLI::Option* option : command.get_options()) text += roff_of(*option);
  return text;
}

/// How a shell asks whether the words before the cursor name this command.
std::string condition_of(const CLI::App& command) {
  return "__fish_seen_subcommand_from " +
         replaced(full_name(command), " ", "; and __fish_seen_subcommand_from ");
}

/// piblocks(1), for the man macros of roff.
std::string man_page(const CLI::App& app) {
  std::string text = fmt::format(
      ".TH PIBLOCKS 1 \"\" \"piblocks {}\" \"User Commands\"\n"
      ".SH NAME\npiblocks \\- render the colliding blocks that count the digits of pi\n"
      ".SH SYNOPSIS\n.B piblocks\n.I COMMAND\n[\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n{}\n.SH COMMANDS\n",
      kVersion, replaced(roff(app.get_description()), "\n\n", "\n.PP\n"));
  for (const CLI::App* command : leaves_of(app)) text += roff_of(*command);
  return text +
         ".SH EXIT STATUS\n0 done, 1 failed, 2 wrong usage.\n.B piblocks compare\nand\n"
         ".B piblocks golden\nreturn 1 for different, 3 for no reference, 4 for a picture that is "
         "missing, new or of another size, 5 for what cannot be read.\n";
}

/// Right behind a command that takes a scene: names and files.
std::string bash_scenes(const CLI::App& app) {
  std::string commands;
  for (const CLI::App* command : leaves_of(app)) {
    if (!takes_scene(*command)) continue;
    commands += (commands.empty() ? "" : " | ") + replaced(full_name(*command), " ", "\\ ");
  }
  return "  case $command in\n    " + commands +
         ")\n"
         "      if [[ $before != -* && $current != -* ]]; then\n"
         "        mapfile -t COMPREPLY < <(compgen -f -W '" +
         shipped_names() +
         "' -- \"$current\")\n"
         "        compopt -o filenames 2> /dev/null\n"
         "        return\n"
         "      fi ;;\n"
         "  esac\n";
}

/// To be sourced, or installed as bash-completion/completions/piblocks.
std::string bash_completion(const CLI::App& app) {
  std::string text =
      "_piblocks() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words= i\n"
      "  local command=\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    [[ ${COMP_WORDS[i]} == -* ]] || command+=${command:+ }${COMP_WORDS[i]}\n"
      "  done\n"
      "  COMPREPLY=()\n";
  text += "  case $command in\n    '') words='" + names_below(app) + " --help --version' ;;\n";
  for (const CLI::App* command : commands_of(app)) {
    const std::string below = names_below(*command);
    if (!below.empty()) text += fmt::format("    {}) words='{}' ;;\n", command->get_name(), below);
  }
  for (const CLI::App* command : leaves_of(app)) {
    std::string options;
    for (const auto& [option, name] : named_options_of(*command)) options += "--" + name + ' ';
    text += fmt::format("    {0} | {0}\\ *) words='{1}' ;;\n",
                        replaced(full_name(*command), " ", "\\ "), options);
  }
  text += "  esac\n" + bash_scenes(app) + "  case $before in\n";
  for (const auto& [name, words] : kWordOptions) {
    text += fmt::format("    {}) words='{}' ;;\n", name, replaced(words(), ",", ""));
  }
  return text +
         "    *) [[ $command == '' || $command == golden || $current == -* ]] || return ;;\n"
         "  esac\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _piblocks piblocks\n";
}

/// Installed as site-functions/_piblocks.
std::string zsh_completion(const CLI::App& app) {
  std::string text =
      "#compdef piblocks\n"
      "local command\n"
      "local -a commands options\n"
      "commands=(\n";
  for (const CLI::App* command : commands_of(app)) {
    text +=
        "  " + shell_quoted(command->get_name() + ":" + flat(command->get_description())) + "\n";
  }
  text +=
      ")\n"
      "if (( CURRENT == 2 )); then\n"
      "  _describe command commands\n"
      "  return\n"
      "fi\n"
      "command=$words[2]\n";
  for (const CLI::App* command : commands_of(app)) {
    const std::string below = names_below(*command);
    if (below.empty()) continue;
    text += fmt::format(
        "if [[ $command == {0} ]]; then\n"
        "  if (( CURRENT == 3 )); then\n    compadd {1}\n    return\n  fi\n"
        "  command+=\" $words[3]\"\n"
        "fi\n",
        command->get_name(), below);
  }
  text += "case $command in\n";
  for (const CLI::App* command : leaves_of(app)) {
    text += fmt::format("  {})\n    options=(\n", shell_quoted(full_name(*command)));
    for (const auto& [option, name] : named_options_of(*command)) {
      const std::string what =
          replaced(replaced(flat(option->get_description()), "[", "("), "]", ")");
      const std::string words = words_of(*option);
      std::string spec = fmt::format("--{}[{}]", name, replaced(what, ":", "\\:"));
      if (takes_value(*option)) {
        spec += words.empty() ? ":value:_files" : fmt::format(":value:({})", words);
      }
      text += "      " + shell_quoted(spec) + "\n";
    }
    const std::string scenes =
        "{_alternative \"scenes:scene:(" + shipped_names() + ")\" \"files:file:_files\"}";
    text += fmt::format("      '*:file:{}'\n    ) ;;\n", takes_scene(*command) ? scenes : "_files");
  }
  return text + "esac\n_arguments $options\n";
}

/// Installed as vendor_completions.d/piblocks.fish.
std::string fish_completion(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format("complete -c piblocks -n __fish_use_subcommand -f -a {} -d {}\n",
                        command->get_name(), shell_quoted(flat(command->get_description())));
    const std::string below = names_below(*command);
    if (below.empty()) continue;
    text += fmt::format(
        "complete -c piblocks -n '__fish_seen_subcommand_from {0}; and not "
        "__fish_seen_subcommand_from {1}' -f -a '{1}'\n",
        command->get_name(), below);
  }
  for (const CLI::App* command : leaves_of(app)) {
    if (takes_scene(*command)) {
      text += fmt::format("complete -c piblocks -n {} -a {}\n",
                          shell_quoted(condition_of(*command)), shell_quoted(shipped_names()));
    }
    for (const auto& [option, name] : named_options_of(*command)) {
      const std::string words = words_of(*option);
      text +=
          fmt::format("complete -c piblocks -n {} -l {}{}{} -d {}\n",
                      shell_quoted(condition_of(*command)), name, takes_value(*option) ? " -r" : "",
                      words.empty() ? "" : " -f -a " + shell_quoted(words),
                      shell_quoted(flat(option->get_description())));
    }
  }
  return text;
}

void run_manual(const Command& command) {
  using MakeText = std::string (*)(const CLI::App& app);
  const MakeText make_text = *command.value("KIND", [](const std::string& text) {
    return parse_choice<MakeText>(text, {{"man", man_page},
                                         {"bash", bash_completion},
                                         {"zsh", zsh_completion},
                                         {"fish", fish_completion}});
  });
  const std::unique_ptr<Program> program = make_program();
  define_all(*program);
  print_text(make_text(program->app));
}

}  // namespace

void define_manual(Command& command) {
  command.add_argument("KIND", "man, bash, zsh or fish");
  command.on_run([=] { run_manual(command); });
}

}  // namespace piblocks::cli
