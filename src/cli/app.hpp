// The command line as a whole, by CLI11.
// In: nothing. Out: all commands with their options, and a help of at most 100 columns.
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

namespace piblocks::cli {

/// The text of an option whose name says all: an empty one would be replaced by CLI11.
inline constexpr const char* kNoText = " ";

std::unique_ptr<CLI::App> make_app();

/// The commands of the program, or of a command that has some.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// "golden check": the command's name behind the program's.
std::string full_name(const CLI::App& command);

}  // namespace piblocks::cli
