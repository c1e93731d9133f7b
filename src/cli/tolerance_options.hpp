// What comparisons accept, as options.
// In: options of 'piblocks compare'. Out: a tolerance and masks.
#pragma once

#include <piblocks/compare.hpp>

#include <array>
#include <string>

#include "cli/option_texts.hpp"

namespace piblocks::cli {

struct ToleranceOption {
  const char* name;
  bool has_value = true;
};

/// The options that read_tolerance() reads.
inline constexpr auto kToleranceOptions =
    std::to_array<ToleranceOption>({{"--max-delta"},
                                    {"--threshold"},
                                    {"--count-antialiasing", false},
                                    {"--ignore-transparent", false},
                                    {"--max-pixels"},
                                    {"--hard-delta"},
                                    {"--max-window"},
                                    {"--mask"}});

/// Gives the job its tolerance and its masks. @throws UsageError
void read_tolerance(const OptionTexts& options, ComparisonJob& job);

/// A mask that hides what is neither black nor transparent in a picture of this text.
/// @throws UsageError if that is nothing
Mask mask_of_picture(const std::string& text, const Image& picture);

}  // namespace piblocks::cli
