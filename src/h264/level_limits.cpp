#include "h264/level_limits.hpp"

#include <algorithm>

#include "h264/error.hpp"

namespace piblocks::h264 {

std::string level_problem(int width_px, int height_px, std::int64_t rate_numerator,
                          std::int64_t rate_denominator) {
  constexpr std::int64_t kMaxRate_mb = 16'711'680;  // MaxMBPS, a second
  const std::int64_t width_mb = (std::int64_t{width_px} + 15) / 16;
  const std::int64_t height_mb = (std::int64_t{height_px} + 15) / 16;
  const std::int64_t size_mb = width_mb * height_mb;
  if (std::max(width_mb, height_mb) > kMaxSide_mb) {
    return message("a side of ", std::max(width_px, height_px), " px is longer than the ",
                   16 * kMaxSide_mb, " px of level 6.2, the highest");
  }
  if (size_mb > kMaxPicture_mb) {
    return message(width_px, "x", height_px, " are ", size_mb,
                   " macroblocks of 16x16 pixels, more than the ", kMaxPicture_mb,
                   " of level 6.2, the highest");
  }
  if (size_mb * rate_numerator > kMaxRate_mb * rate_denominator) {
    const std::string divisor = rate_denominator == 1 ? "" : message("/", rate_denominator);
    return message(size_mb, " macroblocks of 16x16 pixels in each of ", rate_numerator, divisor,
                   " frames a second are more than the ", kMaxRate_mb,
                   " a second of level 6.2, the highest");
  }
  return {};
}

}  // namespace piblocks::h264
