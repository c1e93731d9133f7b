// Pixels as files hold them: three bytes, red first, or four with alpha.
// In: a row of 32-bit pixels, or two rows of bytes. Out: the same row as bytes, or how the rows
// differ.
#pragma once

#include <cstddef>
#include <cstdint>

namespace piblocks {

/// @param row   of `width_px` pixels as in ImageView.
/// @param bytes takes 3 * width_px bytes; must not overlap the row.
void pack_rgb24(const std::uint8_t* row, int width_px, std::uint8_t* bytes);

/// A colour sample that was multiplied by alpha / 255, as it was before: 255 sample / alpha,
/// rounded to the nearest, of two the greater; 0 where nothing is seen of it.
constexpr std::uint8_t unmultiplied(std::uint32_t sample, std::uint32_t alpha) {
  if (alpha == 0) return 0;
  return static_cast<std::uint8_t>(sample >= alpha ? 255 : (510 * sample + alpha) / (2 * alpha));
}

/// Red, green and blue as they were before they were multiplied, then alpha.
/// @param row   of `width_px` pixels of an ImageView with alpha.
/// @param bytes takes 4 * width_px bytes; must not overlap the row.
void pack_rgba32(const std::uint8_t* row, int width_px, std::uint8_t* bytes);

/// difference[i] = minuend[i] - subtrahend[i], modulo 256, for i < count: PNG's filter Up.
void subtract_bytes(const std::uint8_t* minuend, const std::uint8_t* subtrahend, std::size_t count,
                    std::uint8_t* difference);

}  // namespace piblocks
