// One image as a PNG file in memory.
// In: a view of opaque pixels. Out: the bytes of a valid PNG (8-bit RGB, sRGB).
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <vector>

namespace piblocks {

/// Encodes losslessly and deterministically: equal pixels give equal bytes.
/// @throws MediaError if memory for the compressor runs out.
std::vector<std::uint8_t> encode_png(const ImageView& image);

}  // namespace piblocks
