// The manual page, and completions for shells, made from the options themselves.
// In: the command line. Out: text that is installed with the program.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace piblocks::cli {

/// piblocks(1), for the man macros of roff.
std::string man_page(const CLI::App& app);

/// To be sourced, or installed as bash-completion/completions/piblocks.
std::string bash_completion(const CLI::App& app);
/// Installed as site-functions/_piblocks.
std::string zsh_completion(const CLI::App& app);
/// Installed as vendor_completions.d/piblocks.fish.
std::string fish_completion(const CLI::App& app);

}  // namespace piblocks::cli
