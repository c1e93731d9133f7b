#include "h264/picture.hpp"

#include <algorithm>

namespace piblocks::h264 {
namespace {

template <int side>
void copy_plane(const std::uint8_t* from, std::ptrdiff_t from_stride, std::uint8_t* to,
                std::ptrdiff_t to_stride) {
  for (int y = 0; y < side; ++y, from += from_stride, to += to_stride) std::memcpy(to, from, side);
}

template <int side>
bool is_plane_equal(const std::uint8_t* a, std::ptrdiff_t a_stride, const std::uint8_t* b,
                    std::ptrdiff_t b_stride) {
  for (int y = 0; y < side; ++y) {
    if (std::memcmp(a + y * a_stride, b + y * b_stride, side) != 0) return false;
  }
  return true;
}

/// The samples of a plane from (left, above) to before (right, below).
struct Area {
  int left, above, right, below;
};

/// Those of a macroblock's plane that lie in the rectangle.
template <int side>
Area common_area(int x_mb, int y_mb, const Rect& rect) {
  constexpr int kStep = kLumaSide / side;
  return {std::max(side * x_mb, rect.x_px / kStep), std::max(side * y_mb, rect.y_px / kStep),
          std::min(side * (x_mb + 1), (rect.x_px + rect.width_px) / kStep),
          std::min(side * (y_mb + 1), (rect.y_px + rect.height_px) / kStep)};
}

/// @param from, to  the upper left sample of the area. @returns whether that changes anything
template <int side>
bool update_area(const Area& area, const std::uint8_t* from, std::ptrdiff_t from_stride,
                 std::uint8_t* to, std::ptrdiff_t to_stride) {
  const auto width = static_cast<std::size_t>(area.right - area.left);
  const int height = area.below - area.above;
  if (width == side && height == side) {
    if (is_plane_equal<side>(from, from_stride, to, to_stride)) return false;
    copy_plane<side>(from, from_stride, to, to_stride);
    return true;
  }
  bool differs = false;
  for (int y = 0; y < height; ++y, from += from_stride, to += to_stride) {
    if (std::memcmp(from, to, width) == 0) continue;
    std::memcpy(to, from, width);
    differs = true;
  }
  return differs;
}

}  // namespace

int largest_difference(const Samples& a, const Samples& b) {
  std::uint8_t largest = 0;
  for (int i = 0; i < Samples::kCount; ++i) {
    const std::uint8_t x = a.values[i];
    const std::uint8_t y = b.values[i];
    largest = std::max(largest, static_cast<std::uint8_t>(std::max(x, y) - std::min(x, y)));
  }
  return largest;
}

Picture::Picture(int width_mb, int height_mb) : width_mb_(width_mb), height_mb_(height_mb) {
  const std::size_t macroblocks = static_cast<std::size_t>(width_mb) * height_mb;
  for (int i = 0; i < 3; ++i) planes_[i].resize(macroblocks * side_of(i) * side_of(i));
}

void Picture::load(int x_mb, int y_mb, Samples& samples) const {
  copy_plane<16>(plane(0) + offset(0, x_mb, y_mb), stride_bytes(0), samples.plane(0), 16);
  for (int i = 1; i < 3; ++i) {
    copy_plane<8>(plane(i) + offset(i, x_mb, y_mb), stride_bytes(i), samples.plane(i), 8);
  }
}

void Picture::store(int x_mb, int y_mb, const Samples& samples) {
  copy_plane<16>(samples.plane(0), 16, plane(0) + offset(0, x_mb, y_mb), stride_bytes(0));
  for (int i = 1; i < 3; ++i) {
    copy_plane<8>(samples.plane(i), 8, plane(i) + offset(i, x_mb, y_mb), stride_bytes(i));
  }
}

template <int side>
bool Picture::update_plane(int number, int x_mb, int y_mb, const Plane& part, const Rect& rect) {
  constexpr int kStep = kLumaSide / side;
  const Area area = common_area<side>(x_mb, y_mb, rect);
  const std::uint8_t* const from = part.samples +
                                   (area.above - rect.y_px / kStep) * part.stride_bytes +
                                   (area.left - rect.x_px / kStep);
  std::uint8_t* const to = plane(number) + area.above * stride_bytes(number) + area.left;
  return update_area<side>(area, from, part.stride_bytes, to, stride_bytes(number));
}

bool Picture::update(int x_mb, int y_mb, const Planes& part, const Rect& rect) {
  const bool has_y = update_plane<16>(0, x_mb, y_mb, part.y, rect);
  const bool has_cb = update_plane<8>(1, x_mb, y_mb, part.cb, rect);
  const bool has_cr = update_plane<8>(2, x_mb, y_mb, part.cr, rect);
  return has_y || has_cb || has_cr;
}

void Picture::extend(int x_mb, int y_mb, int width_px, int height_px) {
  for (int i = 0; i < 3; ++i) {
    const int side = side_of(i);
    const int step = kLumaSide / side;
    const int last_x = std::min(side * (x_mb + 1), width_px / step) - 1;
    const int last_y = std::min(side * (y_mb + 1), height_px / step) - 1;
    for (int y = side * y_mb; y < side * (y_mb + 1); ++y) {
      std::uint8_t* const row = plane(i) + y * stride_bytes(i);
      const std::uint8_t* const from = plane(i) + std::min(y, last_y) * stride_bytes(i);
      if (y > last_y) std::memcpy(row + side * x_mb, from + side * x_mb, side);
      std::fill(row + last_x + 1, row + side * (x_mb + 1), from[last_x]);
    }
  }
}

void Picture::copy(int x_mb, int y_mb, const Picture& from) {
  const std::ptrdiff_t luma = offset(0, x_mb, y_mb);
  copy_plane<16>(from.plane(0) + luma, stride_bytes(0), plane(0) + luma, stride_bytes(0));
  const std::ptrdiff_t chroma = offset(1, x_mb, y_mb);
  for (int i = 1; i < 3; ++i) {
    copy_plane<8>(from.plane(i) + chroma, stride_bytes(i), plane(i) + chroma, stride_bytes(i));
  }
}

void Picture::load_borders(int x_mb, int y_mb, Borders& borders) const {
  borders.has_above = y_mb > 0;
  borders.has_left = x_mb > 0;
  for (int i = 0; i < 3; ++i) {
    const int side = side_of(i);
    const std::uint8_t* const corner = plane(i) + offset(i, x_mb, y_mb);
    Border& border = borders.planes[i];
    if (borders.has_above) std::memcpy(border.above.data(), corner - stride_bytes(i), side);
    if (!borders.has_left) continue;
    for (int y = 0; y < side; ++y) border.left[y] = corner[y * stride_bytes(i) - 1];
  }
}

}  // namespace piblocks::h264
