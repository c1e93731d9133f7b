// The program's arguments.
// In: those of main(). Out: the command that they name has run.
#pragma once

namespace piblocks::cli {

/// @returns the exit code. @throws what commands throw
int run_command_line(int argc, char** argv);

}  // namespace piblocks::cli
