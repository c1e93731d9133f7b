// A picture that remembers what has changed in it: what a frame of a GIF or an APNG has to hold.
// In: frames, with the rectangles that may have changed. Out: the pixels, the smallest rectangle
// around those that have changed, and a mark on each of them.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace piblocks {

class ChangedPicture {
 public:
  ChangedPicture(int width_px, int height_px);

  /// @param rects  cover every pixel in which the frame differs from the one taken before.
  void take(const ImageView& frame, std::span<const PixelRect> rects);
  /// Forgets what has changed.
  void settle();
  /// Takes everything for changed.
  void mark_all();

  bool has_changed() const noexcept { return left_ < right_; }
  /// Around all that has changed since settle(). One pixel if nothing has: no image is empty.
  PixelRect changed() const noexcept;
  /// Pixels as ImageView has them.
  const std::uint32_t* row(int y) const noexcept { return words_.data() + offset(y); }
  ImageView view(bool has_alpha) const noexcept {
    return {.data = reinterpret_cast<const std::uint8_t*>(words_.data()),
            .width_px = width_px_,
            .height_px = height_px_,
            .stride_bytes = std::ptrdiff_t{4} * width_px_,
            .has_alpha = has_alpha};
  }
  /// 1 for each pixel that has changed since settle(), else 0.
  const std::uint8_t* marks(int y) const noexcept { return marks_.data() + offset(y); }

 private:
  std::size_t offset(int y) const noexcept { return std::size_t(y) * std::size_t(width_px_); }
  void take_row(const ImageView& frame, const PixelRect& rect, int y);

  int width_px_;
  int height_px_;
  std::vector<std::uint32_t> words_;
  std::vector<std::uint8_t> marks_;
  // The rectangle; empty if left is not before right.
  int left_;
  int top_;
  int right_ = 0;
  int bottom_ = 0;
};

}  // namespace piblocks
