// How large and how fast a stream of H.264 can be.
// In: the size of its pictures and their rate. Out: whether a level of the standard allows them,
// and if not, what it is that none does.
#pragma once

#include <cstdint>
#include <string>

namespace piblocks::h264 {

/// Limits of a level, from ITU-T H.264 (08/2021), table A-1. Of frames, not fields.
struct LevelLimits {
  std::int64_t macroblocks_per_second;  ///< MaxMBPS
  std::int64_t macroblocks;             ///< MaxFS, of one picture
};

/// The highest level, 6.2, allows all that any of them does.
inline constexpr LevelLimits kHighestLevel = {16'711'680, 139'264};

/// The longest side of a picture, in macroblocks: floor(Sqrt(8 MaxFS)), by A.3.1, items f and g.
std::int64_t max_side_mb(const LevelLimits& limits);

/// Empty if the highest level allows such pictures at this many of them a second; else which of its
/// limits they exceed.
/// @param rate_numerator    1 … 2^31 - 1; frames in so many seconds:
/// @param rate_denominator  1 … 2^31 - 1
std::string level_problem(int width_px, int height_px, std::int64_t rate_numerator,
                          std::int64_t rate_denominator);

}  // namespace piblocks::h264
