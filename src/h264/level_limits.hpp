// How large and how fast a stream of H.264 can be.
// In: the size of its pictures and their rate. Out: the limit of the highest level that they
// exceed.
#pragma once

#include <cstdint>
#include <string>

namespace piblocks::h264 {

/// MaxFS of level 6.2, which allows all that any level does: macroblocks of a picture (ITU-T H.264
/// (08/2021), table A-1).
inline constexpr std::int64_t kMaxPicture_mb = 139'264;
/// The longest side of a picture: floor(Sqrt(8 MaxFS)), by A.3.1, items f and g.
inline constexpr std::int64_t kMaxSide_mb = 1055;
static_assert(kMaxSide_mb * kMaxSide_mb <= 8 * kMaxPicture_mb &&
              (kMaxSide_mb + 1) * (kMaxSide_mb + 1) > 8 * kMaxPicture_mb);

/// Empty if level 6.2 allows such pictures at the rate numerator / denominator a second; else which
/// of its limits they exceed.
/// @param rate_numerator, rate_denominator  1 … 2^31 - 1
std::string level_problem(int width_px, int height_px, std::int64_t rate_numerator,
                          std::int64_t rate_denominator);

}  // namespace piblocks::h264
