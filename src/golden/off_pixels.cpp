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
    // Local copies: the compiler has to load members again after every write to a column.
    const std::uint8_t* const row = is_off_.data() + index(0, y);
    int* const column = columns.data();
    const int count = width_px_;
    for (int x = 0; x < count; ++x) column[x] += sign * row[x];
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
  const int width = window.width_px;
  const int* const column = columns.data();
  int sum = 0;
  for (int x = 0; x < width_px_; ++x) {
    sum += column[x];
    if (x >= width) sum -= column[x - width];
    if (x + 1 < width || sum <= result.densest_off) continue;
    result.densest_off = sum;
    window.x_px = x + 1 - width;
    result.densest = window;
  }
}

}  // namespace piblocks
