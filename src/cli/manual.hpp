// The manual page, and completions for shells, made from the options themselves.
// In: nothing. Out: text that is installed with the program.
#pragma once

#include <string>

namespace piblocks::cli {

/// piblocks(1), for the man macros of roff.
std::string man_page();

/// To be sourced, or installed as bash-completion/completions/piblocks.
std::string bash_completion();
/// Installed as site-functions/_piblocks.
std::string zsh_completion();
/// Installed as vendor_completions.d/piblocks.fish.
std::string fish_completion();

}  // namespace piblocks::cli
