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

/// Takes a square of samples. @returns whether that changes anything
template <int side>
bool update_plane(const std::uint8_t* from, std::ptrdiff_t from_stride, std::uint8_t* to,
                  std::ptrdiff_t to_stride) {
  if (is_plane_equal<side>(from, from_stride, to, to_stride)) return false;
  copy_plane<side>(from, from_stride, to, to_stride);
  return true;
}

/// The macroblock's part of a plane of width x height samples, continued beyond its edges.
template <int side>
void load_continued(const Plane& plane, int x_mb, int y_mb, int width, int height,
                    std::uint8_t* to) {
  for (int y = 0; y < side; ++y) {
    const std::uint8_t* const row =
        plane.samples + std::min(side * y_mb + y, height - 1) * plane.stride_bytes;
    for (int x = 0; x < side; ++x) *to++ = row[std::min(side * x_mb + x, width - 1)];
  }
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

bool Picture::update(int x_mb, int y_mb, const Planes& from, int width_px, int height_px) {
  const std::ptrdiff_t luma = offset(0, x_mb, y_mb);
  const std::ptrdiff_t chroma = offset(1, x_mb, y_mb);
  const auto update_all = [&](const Plane& y, const Plane& cb, const Plane& cr) {
    const bool has_luma =
        update_plane<16>(y.samples, y.stride_bytes, plane(0) + luma, stride_bytes(0));
    const bool has_cb =
        update_plane<8>(cb.samples, cb.stride_bytes, plane(1) + chroma, stride_bytes(1));
    const bool has_cr =
        update_plane<8>(cr.samples, cr.stride_bytes, plane(2) + chroma, stride_bytes(2));
    return has_luma || has_cb || has_cr;
  };
  if (16 * (x_mb + 1) <= width_px && 16 * (y_mb + 1) <= height_px) {
    const auto at = [&](const Plane& plane, int side) -> Plane {
      return {plane.samples + side * (y_mb * plane.stride_bytes + x_mb), plane.stride_bytes};
    };
    return update_all(at(from.y, 16), at(from.cb, 8), at(from.cr, 8));
  }
  Samples samples;  // NOLINT(cppcoreguidelines-pro-type-member-init): all are written
  load_continued<16>(from.y, x_mb, y_mb, width_px, height_px, samples.plane(0));
  load_continued<8>(from.cb, x_mb, y_mb, width_px / 2, height_px / 2, samples.plane(1));
  load_continued<8>(from.cr, x_mb, y_mb, width_px / 2, height_px / 2, samples.plane(2));
  return update_all({samples.plane(0), 16}, {samples.plane(1), 8}, {samples.plane(2), 8});
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
