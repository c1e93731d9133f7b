// Keeps frames and other bytes off the screen.
// In: the option that says where output goes. Out: nothing, or a UsageError.
#pragma once

#include <unistd.h>

#include "cli/options.hpp"

namespace piblocks::cli {

/// @throws UsageError if the output is "-", as it is where the option is not given, and standard
/// output is a terminal.
inline void refuse_terminal(const Option& output) {
  if (output.text().value_or("-") != "-" || isatty(STDOUT_FILENO) == 0) return;
  throw UsageError("--output -: standard output is a terminal; pipe it or redirect it to a file");
}

}  // namespace piblocks::cli
