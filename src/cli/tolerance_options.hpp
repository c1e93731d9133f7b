// What comparisons accept, as options.
// In: options of 'piblocks compare'. Out: a tolerance and masks.
#pragma once

#include <piblocks/compare.hpp>

#include <array>

#include "cli/option_texts.hpp"

namespace piblocks::cli {

/// The options that read_tolerance() reads.
inline constexpr std::array kToleranceOptions = {
    "--max-delta",  "--threshold",  "--count-antialiasing", "--ignore-transparent",
    "--max-pixels", "--hard-delta", "--max-window",         "--mask"};

/// Gives the job its tolerance and its masks. @throws UsageError
void read_tolerance(const OptionTexts& options, ComparisonJob& job);

}  // namespace piblocks::cli
