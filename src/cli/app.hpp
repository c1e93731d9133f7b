// The command line as a whole.
// In: nothing. Out: all commands with their options.
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

namespace piblocks::cli {

std::unique_ptr<CLI::App> make_app();

/// The commands of the program, or of a command that has some.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// "golden check": the command's name behind the program's.
std::string full_name(const CLI::App& command);

}  // namespace piblocks::cli
