// Pixels as files hold them: three bytes, red first, or four with alpha.
// In: a row of 32-bit pixels, or two rows of bytes. Out: the row as bytes, or their difference.
#pragma once

#include <piblocks/image.hpp>

#include <cstddef>
#include <cstdint>

namespace piblocks {

/// Bytes of a packed pixel.
constexpr std::size_t packed_bytes(bool has_alpha) { return has_alpha ? 4 : 3; }

/// Packs row `y` of a frame, in a rectangle's columns, as R, G, B or as R, G, B, straight alpha.
/// @param bytes  takes packed_bytes() for each pixel; must not overlap the frame.
void pack_row(const ImageView& frame, const PixelRect& rect, int y, std::uint8_t* bytes);

/// The same as R, G, B and straight alpha, which is 255 if the frame has none.
void pack_row_rgba(const ImageView& frame, const PixelRect& rect, int y, std::uint8_t* bytes);

/// A colour sample before it was multiplied by alpha / 255, rounded half up; 0 if alpha is 0.
constexpr std::uint8_t unmultiplied(std::uint32_t sample, std::uint32_t alpha) {
  if (alpha == 0) return 0;
  return std::uint8_t(sample >= alpha ? 255 : (510 * sample + alpha) / (2 * alpha));
}

/// difference[i] = minuend[i] - subtrahend[i], modulo 256, for i < count: PNG's filter Up.
void subtract_bytes(const std::uint8_t* minuend, const std::uint8_t* subtrahend, std::size_t count,
                    std::uint8_t* difference);

}  // namespace piblocks
