// From pixels to 4:2:0, which video encoders and y4m take.
// In: sRGB pixels and an even-aligned rectangle of them. Out: that part of a 4:2:0 picture with
// the BT.709 matrix in limited range, chroma sited left (ITU-T H.273, matrix 1, location 0).
#pragma once

#include <piblocks/image.hpp>

#include <cstddef>
#include <cstdint>

namespace piblocks {

/// A plane of samples; its maker owns the memory.
template <typename Sample>
struct PlaneView {
  Sample* samples = nullptr;
  std::ptrdiff_t stride_bytes = 0;

  Sample* row(int y) const noexcept {
    return reinterpret_cast<Sample*>(reinterpret_cast<std::uint8_t*>(samples) + y * stride_bytes);
  }
};

/// A picture of 8 bits, or of 10 bits in 16. Chroma planes of 4:2:0 have half the width and height.
template <typename Sample>
struct YuvView {
  PlaneView<Sample> y, cb, cr;
  PlaneView<Sample> alpha = {};  ///< none if its samples are null
};

/// The smallest rectangle to convert if pixels of `rect` have changed: even, and with the chroma
/// samples to which an adjacent column contributes.
PixelRect chroma_aligned(const PixelRect& rect, const ImageView& image);

/// Converts `rect` of `image` into the same place of `picture`; no other sample is written.
/// Every sample is within 0.53 of the exact value (tests/media/yuv420_test.cpp), and the same
/// whether it was converted alone or with the whole frame. Chroma reads one column left of the
/// rectangle: a change at column x of the image can change chroma from column x-1 to x+1.
/// @param image of even width and height.
/// @param rect inside the image; all its numbers are even.
void convert_to_yuv420(const ImageView& image, const PixelRect& rect,
                       const YuvView<std::uint8_t>& picture);

}  // namespace piblocks
