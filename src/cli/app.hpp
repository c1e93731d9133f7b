// All commands, their options once they are asked for, and help of at most 100 columns. CLI11 holds
// the table of options and writes the help. It never sees the arguments: its releases read some
// differently. In: nothing. Out: a program whose options have no values yet; command_line.cpp reads
// them.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace piblocks::cli {

class Command;

/// The text of an option whose name says all: an empty one would be replaced by CLI11.
inline constexpr const char* kNoText = " ";

struct Program {
  CLI::App app;
  /// Of commands that have no options yet. Options cost more than most commands do.
  std::map<const CLI::App*, void (*)(Command& command)> definitions;
  std::map<const CLI::App*, std::function<void()>> runs;  ///< what each command does
  std::set<const CLI::Option*> texts;  ///< options whose value may be empty, such as --title
  std::map<const CLI::Option*, std::vector<std::string>> values;  ///< of options that are given
};

/// Makes all commands, which keep a pointer to the program. They have no options yet.
std::unique_ptr<Program> make_program();

/// Gives a command its options and the commands below it, unless it has them.
void define(Program& program, CLI::App& app);
void define_all(Program& program);

bool takes_value(const CLI::Option& option);

/// The commands of the program, or of a command that has some.
std::vector<const CLI::App*> commands_of(const CLI::App& app);
std::vector<std::string> command_names(const CLI::App& app);

/// "golden check": the command's name behind the program's.
std::string full_name(const CLI::App& command);

}  // namespace piblocks::cli
