// The subcommands, one source file each.
// In: an App to which a subcommand is added. Out: its options, and a callback that does the
// work; failures leave it as exceptions.
#pragma once

#include <CLI/CLI.hpp>

namespace piblocks::cli {

void add_render(CLI::App& app);
void add_join(CLI::App& app);
void add_still(CLI::App& app);
void add_sheet(CLI::App& app);
void add_log(CLI::App& app);
void add_state(CLI::App& app);
void add_count(CLI::App& app);
void add_compare(CLI::App& app);
void add_golden(CLI::App& app);
void add_info(CLI::App& app);
void add_manual(CLI::App& app);

}  // namespace piblocks::cli
