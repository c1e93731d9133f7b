// What is wrong with a command line that CLI11 did not accept.
// In: its exception, and the App as it was left. Out: one line that names the argument and says
// what to do.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace piblocks::cli {

std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace piblocks::cli
