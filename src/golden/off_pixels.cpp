#include "golden/off_pixels.hpp"

#include <algorithm>

namespace piblocks {

OffPixels::OffPixels(int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      top_(height_px),
      is_off_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

void OffPixels::add(int x, int y) {
  is_off_[index(x, y)] = 1;
  top_ = std::min(top_, y);
  bottom_ = std::max(bottom_, y);
}

/// Counts of the columns of a band of rows, and sums of these, each made from the one before.
void OffPixels::find_densest(int side_px, Difference& result) const {
  const int width = std::min(side_px, width_px_);
  const int height = std::min(side_px, height_px_);
  std::vector<int> columns(static_cast<std::size_t>(width_px_));
  const auto add_row = [&](int y, int sign) {
    if (y < top_ || y > bottom_) return;
    for (int x = 0; x < width_px_; ++x) columns[std::size_t(x)] += sign * is_off_[index(x, y)];
  };
  for (int y = 0; y < height; ++y) add_row(y, 1);
  for (int y = 0;; ++y) {
    if (y + height > top_ && y <= bottom_) look_along(columns, {0, y, width, height}, result);
    if (y + height >= height_px_) return;
    add_row(y, -1);
    add_row(y + height, 1);
  }
}

void OffPixels::look_along(const std::vector<int>& columns, PixelRect window,
                           Difference& result) const {
  std::int64_t sum = 0;
  for (int x = 0; x < width_px_; ++x) {
    sum += columns[std::size_t(x)];
    if (x >= window.width_px) sum -= columns[std::size_t(x - window.width_px)];
    if (x + 1 < window.width_px || sum <= result.densest_off) continue;
    result.densest_off = sum;
    window.x_px = x + 1 - window.width_px;
    result.densest = window;
  }
}

}  // namespace piblocks
