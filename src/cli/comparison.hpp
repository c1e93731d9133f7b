// 'piblocks compare', and what 'golden check' of a folder has in common with it: options, lines,
// reports.
// In: a job. Out: lines on standard output, reports, an exit code.
#pragma once

#include <piblocks/compare.hpp>

#include <functional>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace piblocks::cli {

void define_tolerance(Command& command);
void define_reports(Command& command);

/// More lines below the summary.
using MakeNotes = std::function<std::vector<std::string>(const ComparisonResult& result)>;

/// Compares, prints a line for every frame that is not equal, and writes the reports that the
/// options ask for.
/// @throws ExitError with the exit code of the comparison unless that is 0; UsageError if a report
///         would replace what is compared
void run_comparison(const Command& options, const ComparisonJob& job,
                    const MakeNotes& make_notes = {});

}  // namespace piblocks::cli
