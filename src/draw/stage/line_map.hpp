// Where blocks on a line and their velocities are in a picture.
// In: a picture and how it was laid out. Out: places in pixels, to point at.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

struct LineMap {
  double scale = 1;    ///< pixels per unit of length
  double zero_px = 0;  ///< of position 0
  double floor_px = 0;
  /// Of each block, in units of the scene and in pixels.
  struct Block {
    double width;
    double height_px;
  };
  std::vector<Block> blocks = {};
  /// An arrow of a small velocity is so many times as long. One of length l is that of the velocity
  /// l / (1 - l / longest_arrow_px) / px_per_speed. Both are 0 without arrows.
  double px_per_speed = 0;
  double longest_arrow_px = 0;

  Rect at(std::size_t block, double position) const {
    const auto& [width, height_px] = blocks[block];
    return {zero_px + (position - width / 2) * scale, floor_px - height_px, width * scale,
            height_px};
  }
};

/// Tail and tip of the arrow above a block, one of so many, in a picture; nothing without it.
std::optional<std::array<Point, 2>> arrow_in(const DrawList& list, std::size_t block,
                                             std::size_t count);

}  // namespace piblocks
