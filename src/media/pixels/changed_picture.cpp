#include "media/pixels/changed_picture.hpp"

#include <algorithm>
#include <cstring>

namespace piblocks {

ChangedPicture::ChangedPicture(int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      words_(std::size_t(width_px) * std::size_t(height_px)),
      marks_(words_.size()),
      left_(width_px),
      top_(height_px) {}

void ChangedPicture::take(const ImageView& frame, std::span<const PixelRect> rects) {
  for (const PixelRect& rect : rects) {
    for (int y = rect.y_px; y < rect.bottom_px(); ++y) take_row(frame, rect, y);
  }
}

void ChangedPicture::take_row(const ImageView& frame, const PixelRect& rect, int y) {
  const std::uint8_t* const from = frame.row(y) + std::ptrdiff_t{4} * rect.x_px;
  std::uint32_t* const to = words_.data() + offset(y) + rect.x_px;
  std::uint8_t* const row_marks = marks_.data() + offset(y) + rect.x_px;
  // The byte of the alpha is undefined in opaque frames.
  const std::uint32_t opaque = frame.has_alpha ? 0 : 0xff000000;
  int first = rect.width_px;
  int last = 0;
  for (int x = 0; x < rect.width_px; ++x) {
    std::uint32_t word = 0;
    std::memcpy(&word, from + std::ptrdiff_t{4} * x, sizeof word);
    word |= opaque;
    if (word == to[x]) continue;
    to[x] = word;
    row_marks[x] = 1;
    first = std::min(first, x);
    last = x;
  }
  if (first == rect.width_px) return;
  left_ = std::min(left_, rect.x_px + first);
  right_ = std::max(right_, rect.x_px + last + 1);
  top_ = std::min(top_, y);
  bottom_ = std::max(bottom_, y + 1);
}

void ChangedPicture::settle() {
  for (int y = top_; y < bottom_; ++y) {
    std::fill_n(marks_.data() + offset(y) + left_, right_ - left_, std::uint8_t{0});
  }
  left_ = width_px_;
  top_ = height_px_;
  right_ = bottom_ = 0;
}

void ChangedPicture::mark_all() {
  std::ranges::fill(marks_, std::uint8_t{1});
  left_ = top_ = 0;
  right_ = width_px_;
  bottom_ = height_px_;
}

PixelRect ChangedPicture::changed() const noexcept {
  if (!has_changed()) return {0, 0, 1, 1};
  return {.x_px = left_, .y_px = top_, .width_px = right_ - left_, .height_px = bottom_ - top_};
}

}  // namespace piblocks
