// Masks that are pictures: what is neither black nor transparent in them is left out.
// In: a picture. Out: rectangles that cover these pixels, and no others.
#pragma once

#include <piblocks/image.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace piblocks {

/// Runs of pixels, row by row; a run that is repeated below makes one rectangle.
inline std::vector<PixelRect> rects_of_mask(const Image& picture) {
  std::vector<PixelRect> rects;
  std::vector<std::size_t> above;  // rectangles that end at the row above, from left to right
  const auto is_left_out = [](std::uint32_t word) {
    return word >> 24 != 0 && (word & 0xffffff) != 0;
  };
  for (int y = 0; y < picture.height_px; ++y) {
    const std::uint32_t* const row = picture.words.data() + std::ptrdiff_t{y} * picture.width_px;
    std::vector<std::size_t> reached;
    for (int x = 0, end = 0; x < picture.width_px; x = end + 1) {
      for (end = x; end < picture.width_px && is_left_out(row[end]);) ++end;
      if (end == x) continue;
      const auto same = std::ranges::find_if(
          above, [&](std::size_t i) { return rects[i].x_px == x && rects[i].width_px == end - x; });
      reached.push_back(same == above.end() ? rects.size() : *same);
      if (same == above.end()) rects.push_back({x, y, end - x, 0});
      ++rects[reached.back()].height_px;
    }
    above = std::move(reached);
  }
  return rects;
}

}  // namespace piblocks
