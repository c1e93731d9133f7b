// Options that several commands have.
// In: a command. Out: the value of its option, or a UsageError that says what is expected.
#pragma once

#include <string>

#include "cli/command.hpp"
#include "cli/values.hpp"

namespace piblocks::cli {

/// The name that --output gives; "-" if it is not given.
std::string output_of(const Command& command);
/// @throws UsageError if the output is "-" and standard output is a terminal.
void refuse_terminal(const Command& command);

}  // namespace piblocks::cli
