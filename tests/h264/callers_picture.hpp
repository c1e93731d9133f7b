// A picture as a caller may have it: of any even size, with rows as far apart as he likes.
// In: samples. Out: planes. There is no byte after the last row: the encoder may not read any.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "h264/encoder.hpp"
#include "h264/picture.hpp"

namespace piblocks::h264 {

/// Adds all macroblocks that share a pixel with a rectangle inside the picture.
inline void add(MacroblockSet& set, int x_px, int y_px, int width_px, int height_px) {
  if (width_px <= 0 || height_px <= 0) return;
  for (int y = y_px / 16; y <= (y_px + height_px - 1) / 16; ++y) {
    for (int x = x_px / 16; x <= (x_px + width_px - 1) / 16; ++x) set.add_one(x, y);
  }
}

class CallersPicture {
 public:
  CallersPicture(int width_px, int height_px, int padding_bytes = 0)
      : width_px_(width_px), height_px_(height_px), padding_bytes_(padding_bytes) {
    for (int plane = 0; plane < 3; ++plane) {
      samples_[std::size_t(plane)] = std::make_unique<std::uint8_t[]>(size_bytes(plane));
    }
  }

  int width(int plane) const { return plane == 0 ? width_px_ : width_px_ / 2; }
  int height(int plane) const { return plane == 0 ? height_px_ : height_px_ / 2; }
  std::ptrdiff_t stride_bytes(int plane) const { return width(plane) + padding_bytes_; }
  std::uint8_t* row(int plane, int y) {
    return samples_[std::size_t(plane)].get() + y * stride_bytes(plane);
  }
  const std::uint8_t* row(int plane, int y) const {
    return samples_[std::size_t(plane)].get() + y * stride_bytes(plane);
  }
  Planes planes() const {
    const auto plane = [&](int number) -> Plane { return {row(number, 0), stride_bytes(number)}; };
    return {plane(0), plane(1), plane(2)};
  }

  /// @param value_at  of plane, column and row.
  template <typename ValueAt>
  void set(ValueAt value_at) {
    for (int plane = 0; plane < 3; ++plane) {
      for (int y = 0; y < height(plane); ++y) {
        for (int x = 0; x < width(plane); ++x) {
          row(plane, y)[x] = static_cast<std::uint8_t>(value_at(plane, x, y));
        }
      }
    }
  }
  /// The upper left of a picture of whole macroblocks.
  void copy(const Picture& picture) {
    set([&](int plane, int x, int y) {
      return picture.plane(plane)[y * picture.stride_bytes(plane) + x];
    });
  }
  /// What is between the rows.
  void set_padding(std::uint8_t value) {
    for (int plane = 0; plane < 3; ++plane) {
      for (int y = 0; y + 1 < height(plane); ++y) {
        std::fill_n(row(plane, y) + width(plane), padding_bytes_, value);
      }
    }
  }

 private:
  std::size_t size_bytes(int plane) const {
    return std::size_t(stride_bytes(plane) * (height(plane) - 1) + width(plane));
  }

  int width_px_;
  int height_px_;
  int padding_bytes_;
  std::array<std::unique_ptr<std::uint8_t[]>, 3> samples_;
};

/// Of the same picture, from pixel (x, y) on.
inline Planes planes_from(const Planes& planes, int x, int y) {
  const auto at = [&](const Plane& plane, int step) -> Plane {
    return {plane.samples + y / step * plane.stride_bytes + x / step, plane.stride_bytes};
  };
  return {at(planes.y, 1), at(planes.cb, 2), at(planes.cr, 2)};
}

/// Encodes a picture of which only these rectangles are taken.
inline CodedPicture encode(Encoder& encoder, const Planes& picture, std::span<const Rect> rects,
                           PictureType type, std::vector<std::uint8_t>& unit) {
  for (const Rect& rect : rects) encoder.take(planes_from(picture, rect.x_px, rect.y_px), rect);
  return encoder.encode(type, unit);
}

}  // namespace piblocks::h264
