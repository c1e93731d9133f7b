// The compression of GIF 89a (appendix F). giflib compresses only for a colour table that is known.
// In: pixels. Out: codes that suit any colour table; then the bytes of an image.
#pragma once

#include <cstdint>
#include <span>

#include "media/output/bytes.hpp"

namespace piblocks {

/// Appends two bytes for each code: the value of a pixel, up to 255; or 256, which clears the table
/// of strings; or a string of that table, from 257 on. @param pixels  at least one
void append_lzw_codes(Bytes& bytes, ByteSpan pixels);

/// Appends the data of an image. @param codes  as append_lzw_codes() writes them
/// @param indices  of the colours that the values of pixels stand for
/// @param bits     of an index, 2 … 8
void append_lzw(Bytes& bytes, ByteSpan codes, const Bytes& indices, int bits);

}  // namespace piblocks
