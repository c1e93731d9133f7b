// What a comparison comes to, for a shell: the one table of exit codes.
// In: the result. Out: the exit code of the most severe thing that was found.
#pragma once

#include <piblocks/compare.hpp>

#include <array>

#include "cli/command.hpp"

namespace piblocks::cli {

/// By Outcome.
inline constexpr std::array<int, kOutcomes> kExitCodes = {
    0, 0, kDifferent, kMismatch, kMismatch, kMismatch, kUnreadable};

/// A side without a frame has a code of its own: without a reference all rows are new, and without
/// the other side all are missing.
inline int exit_code_of(const ComparisonResult& result) {
  const int code = kExitCodes.at(static_cast<std::size_t>(result.worst()));
  if (code == kUnreadable || result.actual_frames == 0) return kUnreadable;
  return result.reference_frames == 0 ? kMissingReference : code;
}

}  // namespace piblocks::cli
