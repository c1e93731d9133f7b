// The commands, one source file each.
// In: the program, to which a command is added. Out: its options, and a callback that does the
// work; failures leave it as exceptions.
#pragma once

#include "cli/command.hpp"

namespace piblocks::cli {

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

}  // namespace piblocks::cli
