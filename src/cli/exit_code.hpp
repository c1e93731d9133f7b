// The exit codes of comparisons: the one table of them.
// In: the result. Out: the exit code of the most severe thing that was found.
#pragma once

#include <piblocks/compare.hpp>

#include <algorithm>
#include <array>

#include "cli/command.hpp"

namespace piblocks::cli {

inline int exit_code_of(Outcome outcome) {
  constexpr std::array<int, kOutcomes> kCodes = {0,         0,         kDifferent, kMismatch,
                                                 kMismatch, kMismatch, kUnreadable};
  return kCodes.at(static_cast<std::size_t>(outcome));
}

/// A side without a frame has a code of its own: without a reference all rows are new, and without
/// the other side all are missing.
inline int exit_code_of(const ComparisonResult& result) {
  const int code = exit_code_of(result.worst());
  if (code == kUnreadable || result.actual_frames == 0) return kUnreadable;
  return result.reference_frames == 0 ? kMissingReference : code;
}

/// The code of the more severe finding, for commands that make several comparisons.
inline int worse_exit_code(int one, int other) {
  constexpr std::array kBySeverity = {kWrongUsage, kUnreadable,       kMismatch,
                                      kDifferent,  kMissingReference, 0};
  return *std::ranges::find_if(kBySeverity, [&](int code) { return code == one || code == other; });
}

}  // namespace piblocks::cli
