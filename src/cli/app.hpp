// All commands with their options, and their help of at most 100 columns. CLI11 holds the table of
// options and writes the help. It never sees the arguments: its releases read some differently.
// In: nothing. Out: a program whose options have no values yet; command_line.cpp reads them.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace piblocks::cli {

/// The text of an option whose name says all: an empty one would be replaced by CLI11.
inline constexpr const char* kNoText = " ";

struct Program {
  CLI::App app;
  std::map<const CLI::App*, std::function<void()>> runs;  ///< what each command does
  std::set<const CLI::Option*> texts;  ///< options whose value may be empty, such as --title
  std::map<const CLI::Option*, std::vector<std::string>> values;  ///< of options that are given
};

/// Makes all commands. They keep a pointer to the program.
std::unique_ptr<Program> make_program();

bool takes_value(const CLI::Option& option);

/// The commands of the program, or of a command that has some.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// "golden check": the command's name behind the program's.
std::string full_name(const CLI::App& command);

}  // namespace piblocks::cli
