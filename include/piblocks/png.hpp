// One image as a PNG file in memory.
// In: a view of pixels. Out: the bytes of a valid PNG (8-bit RGB, with alpha if the view has;
// sRGB).
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <vector>

namespace piblocks {

/// Encodes losslessly and deterministically: equal pixels give equal bytes. PNG keeps colours as
/// they were before they were multiplied by alpha; these are rounded to the nearest.
/// @throws MediaError if memory for the compressor runs out.
std::vector<std::uint8_t> encode_png(const ImageView& image);

}  // namespace piblocks
