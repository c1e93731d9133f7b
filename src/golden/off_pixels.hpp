// Where pixels are off, and where most of them are.
// In: the pixels that are off, one after the other. Out: the window that has the most.
#pragma once

#include <piblocks/compare.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace piblocks {

class OffPixels {
 public:
  OffPixels(int width_px, int height_px);

  void add(int x, int y);
  /// Finds the first of the squares of this side with the most pixels: densest, densest_off.
  void find_densest(int side_px, Difference& result) const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_) +
           static_cast<std::size_t>(x);
  }
  void look_along(const std::vector<int>& columns, PixelRect window, Difference& result) const;

  int width_px_;
  int height_px_;
  int top_;
  int bottom_ = -1;
  std::vector<std::uint8_t> is_off_;
};

}  // namespace piblocks
