// How much may be asked for on the command line.
#pragma once

namespace piblocks::cli {

/// Rows of a log that are written unless --limit asks for more.
inline constexpr long kMaxRows = 100'000'000;
/// Threads of --jobs.
inline constexpr int kMaxJobs = 256;
/// Parts of --part.
inline constexpr int kMaxParts = 100'000;
/// Flashes of --max-flashes: as many as there can be at 60 frames a second.
inline constexpr int kMaxFlashes = 30;

}  // namespace piblocks::cli
