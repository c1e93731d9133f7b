#include "media/output/animated_output.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <cstring>

namespace piblocks {

ChangedPicture::ChangedPicture(int width_px, int height_px, bool has_alpha)
    : width_px_(width_px),
      height_px_(height_px),
      has_alpha_(has_alpha),
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

Bytes AnimationEncoder::encode_picture(std::int64_t number) {
  if (number == 0) picture_.mark_all();
  const bool has_image = picture_.has_changed() || number % most_frames_ == 0;
  Bytes image = has_image ? encode_image(picture_) : Bytes();
  picture_.settle();
  return image;
}

void AnimationSink::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) {
    if (packet.bytes.empty() && last_.bytes.empty()) {
      throw MediaError("output: the first image is missing");
    }
    if (packet.bytes.empty()) continue;
    if (packet.bytes.size() < least_bytes_) throw MediaError("output: an image is cut off");
    write_last(packet.pts);
    last_ = packet;
  }
}

void AnimationSink::finish() {
  write_last(counter_.frames());
  write_end();
  file_.finish();
}

std::uint64_t AnimationSink::ticks_of(std::int64_t first, std::int64_t end, int ticks_per_s) const {
  const auto tick_of = [&](std::int64_t frame) -> Integer {
    return floor(Rational(to_integer(frame)) * ticks_per_s / request_.format.frame_rate +
                 Rational(1, 2));
  };
  return Integer(tick_of(end) - tick_of(first)).get_ui();
}

void AnimationSink::write_last(std::int64_t end) {
  if (!last_.bytes.empty()) write_image(std::move(last_.bytes), last_.pts, end);
}

}  // namespace piblocks
