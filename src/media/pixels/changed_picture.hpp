// A picture that remembers what has changed of it.
// In: frames, with the rectangles that may have changed. Out: the pixels, which of them are new if
// that is asked for, and the least rectangle around those: what a frame of GIF or APNG has to hold.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace piblocks {

class ChangedPicture {
 public:
  /// What is known of each pixel beside the rectangle.
  enum class Marks { none, new_pixels };

  ChangedPicture(int width_px, int height_px, Marks marks);

  /// @param rects  cover every pixel in which the frame differs from the one taken before.
  void take(const ImageView& frame, std::span<const PixelRect> rects);
  /// From here on nothing has changed.
  void settle();

  PixelRect whole() const noexcept { return {0, 0, width_px_, height_px_}; }
  /// Around all that has changed since settle(). If nothing has, one pixel: no frame is empty.
  PixelRect changed() const noexcept;
  /// Pixels as ImageView has them.
  const std::uint32_t* row(int y) const noexcept { return words_.data() + offset(y); }
  /// For each pixel whether it has changed since settle(), with Marks::new_pixels.
  const std::uint8_t* news(int y) const noexcept { return news_.data() + offset(y); }

 private:
  std::size_t offset(int y) const noexcept { return std::size_t(y) * std::size_t(width_px_); }
  void take_row(const ImageView& frame, const PixelRect& rect, int y);

  int width_px_;
  int height_px_;
  std::vector<std::uint32_t> words_;
  std::vector<std::uint8_t> news_;
  // Of what has changed; empty if left is not before right.
  int left_ = 0;
  int top_ = 0;
  int right_ = 0;
  int bottom_ = 0;
};

}  // namespace piblocks
