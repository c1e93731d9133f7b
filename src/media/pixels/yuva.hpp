// From pixels with alpha to what encoders of transparent video take.
// In: sRGB pixels with alpha, or opaque ones, and a rectangle of them. Out: that part of a picture
// with the BT.709 matrix in limited range and alpha in full range; colours as they were before they
// were multiplied by alpha, every sample rounded to the nearest.
#pragma once

#include <piblocks/image.hpp>

#include <cstddef>
#include <cstdint>

namespace piblocks {

/// A plane of samples; the memory belongs to whoever made the view.
template <typename Sample>
struct PlaneView {
  Sample* samples = nullptr;
  std::ptrdiff_t stride_bytes = 0;

  Sample* row(int y) const noexcept {
    return reinterpret_cast<Sample*>(reinterpret_cast<std::uint8_t*>(samples) + y * stride_bytes);
  }
};

/// 4:4:4 with 10 bits in 16: luma 64 to 940, chroma 64 to 960, alpha 0 to 1023. Where nothing is to
/// be seen, black.
struct Yuva444p10View {
  PlaneView<std::uint16_t> y, cb, cr;
  PlaneView<std::uint16_t> alpha;  ///< none if samples is null
};

/// @param rect  inside the image.
void convert_to_yuva444p10(const ImageView& image, const PixelRect& rect,
                           const Yuva444p10View& picture);

/// 4:2:0 with 8 bits, chroma sited left, as yuv420.hpp has it, and alpha 0 to 255 for each pixel.
struct Yuva420View {
  PlaneView<std::uint8_t> y, cb, cr, alpha;
};

/// A chroma sample is the mean of the pixels around it weighted by their alpha as well: what cannot
/// be seen does not colour the edge of what can.
/// @param image of even width and height.
/// @param rect  inside the image; all its numbers are even. Chroma reads one column left of it.
void convert_to_yuva420(const ImageView& image, const PixelRect& rect, const Yuva420View& picture);

}  // namespace piblocks
