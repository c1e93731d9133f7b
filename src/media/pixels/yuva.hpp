// From pixels with alpha to what encoders of transparent video take.
// In: sRGB pixels, with alpha or opaque, and a rectangle of them. Out: that part of a picture with
// the BT.709 matrix in limited range and alpha in full range. Colours are not multiplied by alpha,
// and every sample is rounded to the nearest.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>

#include "media/pixels/yuv420.hpp"

namespace piblocks {

/// 4:4:4 with 10 bits: luma 64 to 940, chroma 64 to 960, alpha 0 to 1023. Transparent pixels are
/// black.
/// @param rect  inside the image.
void convert_to_yuva444p10(const ImageView& image, const PixelRect& rect,
                           const YuvView<std::uint16_t>& picture);

/// 4:2:0 with 8 bits, chroma sited left, alpha 0 to 255 for each pixel. Alpha weighs the pixels of
/// a chroma sample too, so hidden colours do not tint an edge.
/// @param image of even width and height.
/// @param rect  inside the image; all its numbers are even. Chroma reads one column left of it.
void convert_to_yuva420(const ImageView& image, const PixelRect& rect,
                        const YuvView<std::uint8_t>& picture);

}  // namespace piblocks
