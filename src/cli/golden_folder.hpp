// Pictures of any program, held to references in a folder: 'golden check DIR --against REFS'.
// In: options. Out: lines, reports, references; the tolerance, kept beside the references.
#pragma once

#include "cli/command.hpp"

namespace piblocks::cli {

/// Compares the pictures with the references, and writes none. @throws ExitError
void check_folder(const Command& command);
/// Adds references that are missing. Without --missing, those that are there must be accepted.
/// @throws ExitError
void record_folder(const Command& command);
/// Replaces references, all that are not accepted or those that are named.
void approve_folder(const Command& command);

}  // namespace piblocks::cli
