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
bool is_plane_equal(const std::uint8_t* a, const std::uint8_t* b, std::ptrdiff_t stride) {
  for (int y = 0; y < side; ++y) {
    if (std::memcmp(a + y * stride, b + y * stride, side) != 0) return false;
  }
  return true;
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

bool Picture::has_equal(int x_mb, int y_mb, const Picture& other) const {
  const std::ptrdiff_t luma = offset(0, x_mb, y_mb);
  const std::ptrdiff_t chroma = offset(1, x_mb, y_mb);
  return is_plane_equal<16>(plane(0) + luma, other.plane(0) + luma, stride_bytes(0)) &&
         is_plane_equal<8>(plane(1) + chroma, other.plane(1) + chroma, stride_bytes(1)) &&
         is_plane_equal<8>(plane(2) + chroma, other.plane(2) + chroma, stride_bytes(2));
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
