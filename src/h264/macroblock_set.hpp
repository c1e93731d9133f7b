// The macroblocks of a picture that may have changed.
// In: rectangles of pixels. Out: macroblock addresses in raster order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace piblocks::h264 {

class MacroblockSet {
 public:
  MacroblockSet(int width_mb, int height_mb)
      : width_mb_(width_mb), words_((static_cast<std::size_t>(width_mb * height_mb) + 63) / 64) {}

  /// Adds all macroblocks that share a pixel with a rectangle inside the picture.
  void add(int x_px, int y_px, int width_px, int height_px) {
    if (width_px <= 0 || height_px <= 0) return;
    for (int y = y_px / 16; y <= (y_px + height_px - 1) / 16; ++y) {
      for (int x = x_px / 16; x <= (x_px + width_px - 1) / 16; ++x) add_one(y * width_mb_ + x);
    }
  }
  void clear() { words_.assign(words_.size(), 0); }

  template <typename Visit>
  void for_each(Visit visit) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      for (std::uint64_t left = words_[i]; left != 0; left &= left - 1) {
        visit(static_cast<int>(64 * i) + std::countr_zero(left));
      }
    }
  }

 private:
  void add_one(int address) {
    words_[static_cast<std::size_t>(address / 64)] |= std::uint64_t{1} << address % 64;
  }

  int width_mb_;
  std::vector<std::uint64_t> words_;
};

}  // namespace piblocks::h264
