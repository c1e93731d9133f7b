#include "media/h264/level_limits.hpp"

#include <fmt/format.h>

#include <algorithm>

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
    return fmt::format("a side of {} px is longer than the {} px of level 6.2, the highest",
                       std::max(width_px, height_px), kMacroblock_px * max_side_mb(limits));
  }
  if (width * height > limits.macroblocks) {
    return fmt::format(
        "{}x{} are {} macroblocks of 16x16 pixels, more than the {} of level 6.2, the highest",
        width_px, height_px, width * height, limits.macroblocks);
  }
  if (width * height * rate_numerator > limits.macroblocks_per_second * rate_denominator) {
    const std::string rate = rate_denominator == 1
                                 ? fmt::format("{}", rate_numerator)
                                 : fmt::format("{}/{}", rate_numerator, rate_denominator);
    return fmt::format(
        "{} macroblocks of 16x16 pixels in each of {} frames a second are more than the {} a "
        "second "
        "of level 6.2, the highest",
        width * height, rate, limits.macroblocks_per_second);
  }
  return {};
}

}  // namespace piblocks::h264
