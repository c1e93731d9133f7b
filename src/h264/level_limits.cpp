#include "h264/level_limits.hpp"

#include <algorithm>

#include "h264/error.hpp"

namespace piblocks::h264 {
namespace {

constexpr std::int64_t kMacroblock_px = 16;

constexpr std::int64_t macroblocks_along(int side_px) {
  return (side_px + kMacroblock_px - 1) / kMacroblock_px;
}

}  // namespace

std::int64_t max_side_mb(const LevelLimits& limits) {
  std::int64_t side = 0;
  while ((side + 1) * (side + 1) <= 8 * limits.macroblocks) ++side;
  return side;
}

std::string level_problem(int width_px, int height_px, std::int64_t rate_numerator,
                          std::int64_t rate_denominator) {
  const std::int64_t width = macroblocks_along(width_px);
  const std::int64_t height = macroblocks_along(height_px);
  const LevelLimits& limits = kHighestLevel;
  if (std::max(width, height) > max_side_mb(limits)) {
    return message("a side of ", std::max(width_px, height_px), " px is longer than the ",
                   kMacroblock_px * max_side_mb(limits), " px of level 6.2, the highest");
  }
  if (width * height > limits.macroblocks) {
    return message(width_px, "x", height_px, " are ", width * height,
                   " macroblocks of 16x16 pixels, more than the ", limits.macroblocks,
                   " of level 6.2, the highest");
  }
  if (width * height * rate_numerator > limits.macroblocks_per_second * rate_denominator) {
    const std::string divisor = rate_denominator == 1 ? "" : message("/", rate_denominator);
    return message(width * height, " macroblocks of 16x16 pixels in each of ", rate_numerator,
                   divisor, " frames a second are more than the ", limits.macroblocks_per_second,
                   " a second of level 6.2, the highest");
  }
  return {};
}

}  // namespace piblocks::h264
