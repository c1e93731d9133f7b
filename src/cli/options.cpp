#include "cli/options.hpp"

#include <unistd.h>

namespace piblocks::cli {

std::string output_of(const Command& command) { return command.text("--output").value_or("-"); }

void refuse_terminal(const Command& command) {
  if (output_of(command) != "-" || isatty(STDOUT_FILENO) == 0) return;
  throw UsageError("--output -: standard output is a terminal; pipe it or redirect it to a file");
}

}  // namespace piblocks::cli
