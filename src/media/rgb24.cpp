#include "media/rgb24.hpp"

#include <cstring>

namespace piblocks {

void pack_rgb24(const std::uint8_t* __restrict row, int width_px, std::uint8_t* __restrict bytes) {
  for (int x = 0; x < width_px; ++x) {
    std::uint32_t pixel = 0;
    std::memcpy(&pixel, row + 4 * x, sizeof pixel);
    bytes[3 * x] = static_cast<std::uint8_t>(pixel >> 16);
    bytes[3 * x + 1] = static_cast<std::uint8_t>(pixel >> 8);
    bytes[3 * x + 2] = static_cast<std::uint8_t>(pixel);
  }
}

void subtract_bytes(const std::uint8_t* __restrict minuend,
                    const std::uint8_t* __restrict subtrahend, std::size_t count,
                    std::uint8_t* __restrict difference) {
  for (std::size_t i = 0; i < count; ++i) {
    difference[i] = static_cast<std::uint8_t>(minuend[i] - subtrahend[i]);
  }
}

}  // namespace piblocks
