// The command line: all commands, one source file each.
// In: the arguments of main(). Out: the command that they name has run; failures are exceptions.
#pragma once

#include <string>

#include "cli/command.hpp"

namespace piblocks::cli {

/// Runs the command that the arguments name.
/// @returns the exit code. @throws what commands throw
int run_command_line(int argc, char** argv);

// Each adds a command with its options, and what it does.
void add_render(Command& app);
void add_join(Command& app);
void add_still(Command& app);
void add_sheet(Command& app);
void add_log(Command& app);
void add_state(Command& app);
void add_count(Command& app);
void add_compare(Command& app);
void add_golden(Command& app);
void add_info(Command& app);
void add_manual(Command& app);

// The manual, made from the options themselves.

/// piblocks(1), for the man macros of roff.
std::string man_page();

/// To be sourced, or installed as bash-completion/completions/piblocks.
std::string bash_completion();
/// Installed as site-functions/_piblocks.
std::string zsh_completion();
/// Installed as vendor_completions.d/piblocks.fish.
std::string fish_completion();

}  // namespace piblocks::cli
