// Pixels as files hold them: three bytes, red first.
// In: a row of 32-bit pixels, or two rows of bytes. Out: the same row in 24 bits a pixel, or how
// the rows differ.
#pragma once

#include <cstddef>
#include <cstdint>

namespace piblocks {

/// @param row   of `width_px` pixels as in ImageView.
/// @param bytes takes 3 * width_px bytes; must not overlap the row.
void pack_rgb24(const std::uint8_t* row, int width_px, std::uint8_t* bytes);

/// difference[i] = minuend[i] - subtrahend[i], modulo 256, for i < count: PNG's filter Up.
void subtract_bytes(const std::uint8_t* minuend, const std::uint8_t* subtrahend, std::size_t count,
                    std::uint8_t* difference);

}  // namespace piblocks
