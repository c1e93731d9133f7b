#include "media/pixels/rgb24.hpp"

#include <cstring>

namespace piblocks {
namespace {

std::uint32_t pixel_at(const std::uint8_t* row, int x) {
  std::uint32_t pixel = 0;
  std::memcpy(&pixel, row + 4 * x, sizeof pixel);
  return pixel;
}

void pack_rgb24(const std::uint8_t* __restrict row, int count, std::uint8_t* __restrict bytes) {
  for (int x = 0; x < count; ++x) {
    const std::uint32_t pixel = pixel_at(row, x);
    bytes[3 * x] = std::uint8_t(pixel >> 16);
    bytes[3 * x + 1] = std::uint8_t(pixel >> 8);
    bytes[3 * x + 2] = std::uint8_t(pixel);
  }
}

void pack_rgba32(const std::uint8_t* __restrict row, int count, std::uint8_t* __restrict bytes) {
  for (int x = 0; x < count; ++x) {
    std::uint32_t pixel = pixel_at(row, x);
    const std::uint32_t alpha = pixel >> 24;
    if (alpha == 0 || alpha == 255) {
      pixel = (pixel & 0xff00ff00) | (pixel >> 16 & 0xff) | (pixel & 0xff) << 16;
      std::memcpy(bytes + 4 * x, &pixel, sizeof pixel);
      continue;
    }
    bytes[4 * x] = unmultiplied(pixel >> 16 & 0xff, alpha);
    bytes[4 * x + 1] = unmultiplied(pixel >> 8 & 0xff, alpha);
    bytes[4 * x + 2] = unmultiplied(pixel & 0xff, alpha);
    bytes[4 * x + 3] = std::uint8_t(alpha);
  }
}

/// The fourth bytes of pixels without alpha mean nothing.
void pack_opaque(const std::uint8_t* __restrict row, int count, std::uint8_t* __restrict bytes) {
  for (int x = 0; x < count; ++x) {
    std::uint32_t pixel = pixel_at(row, x);
    pixel = 0xff000000 | (pixel & 0xff00) | (pixel >> 16 & 0xff) | (pixel & 0xff) << 16;
    std::memcpy(bytes + 4 * x, &pixel, sizeof pixel);
  }
}

}  // namespace

void pack_row(const ImageView& frame, const PixelRect& rect, int y, std::uint8_t* bytes) {
  const auto pack = frame.has_alpha ? pack_rgba32 : pack_rgb24;
  pack(frame.row(y) + std::ptrdiff_t{4} * rect.x_px, rect.width_px, bytes);
}

void pack_row_rgba(const ImageView& frame, const PixelRect& rect, int y, std::uint8_t* bytes) {
  const auto pack = frame.has_alpha ? pack_rgba32 : pack_opaque;
  pack(frame.row(y) + std::ptrdiff_t{4} * rect.x_px, rect.width_px, bytes);
}

void subtract_bytes(const std::uint8_t* __restrict minuend,
                    const std::uint8_t* __restrict subtrahend, std::size_t count,
                    std::uint8_t* __restrict difference) {
  for (std::size_t i = 0; i < count; ++i) difference[i] = std::uint8_t(minuend[i] - subtrahend[i]);
}

}  // namespace piblocks
