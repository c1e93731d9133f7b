// The compression of GIF 89a (appendix F). giflib compresses only for a colour table that is known.
// In: pixels. Out: codes that suit any colour table; then the bytes of an image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "media/output/bytes.hpp"

namespace piblocks {

/// The value of a pixel, up to 255; or kLzwClear; or a string of the table, from the next one on.
using LzwCode = std::uint16_t;
inline constexpr LzwCode kLzwClear = 256;

/// @param pixels  at least one
std::vector<LzwCode> lzw_codes(std::span<const std::uint8_t> pixels);

/// Appends the data of an image. @param bits  of a pixel, 2 … 8
/// @param indices  of the colours that the values of pixels stand for
void append_lzw(Bytes& bytes, std::span<const LzwCode> codes, std::span<const std::uint8_t> indices,
                int bits);

}  // namespace piblocks
