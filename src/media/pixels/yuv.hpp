// From pixels to what video encoders and y4m take.
// In: sRGB pixels and a rectangle. Out: that part of a picture in BT.709, limited range, with alpha
// in full range and chroma of 4:2:0 sited left (ITU-T H.273, matrix 1, location 0).
#pragma once

#include <piblocks/image.hpp>

#include <cstddef>
#include <cstdint>

namespace piblocks {

// BT.709: the weights of red and blue in luma, in ten thousandths (ITU-R BT.709-6, 3.2).
inline constexpr int kRedWeight = 2126;
inline constexpr int kBlueWeight = 722;
inline constexpr int kAllWeights = 10'000;

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

/// The bytes of a picture in 4:2:0 with 8 bits.
constexpr std::size_t yuv420_bytes(int width_px, int height_px) {
  return std::size_t(width_px) * std::size_t(height_px) / 2 * 3;
}
/// Y, Cb and Cr, one behind the other. @param samples  yuv420_bytes() of them
inline YuvView<std::uint8_t> yuv420_view(std::uint8_t* samples, int width_px, int height_px) {
  const std::ptrdiff_t luma = std::ptrdiff_t{width_px} * height_px;
  return {
      {samples, width_px}, {samples + luma, width_px / 2}, {samples + luma / 4 * 5, width_px / 2}};
}

/// The smallest rectangle to convert if pixels of `rect` have changed: even, and with the chroma
/// samples to which an adjacent column contributes.
PixelRect chroma_aligned(const PixelRect& rect, const ImageView& image);

/// Converts `rect` of `image` into the same place of `picture`; no other sample is written.
/// Every sample is within 0.53 of the exact value (tests/media/yuv420_test.cpp), and the same
/// whether it was converted alone or with the whole frame. Chroma reads one column left of the
/// rectangle: a change at column x of the image can change chroma from column x-1 to x+1.
/// @param image, rect  of even numbers, the rectangle inside the image
void convert_to_yuv420(const ImageView& image, const PixelRect& rect,
                       const YuvView<std::uint8_t>& picture);

/// 4:4:4 with 10 bits: luma 64 to 940, chroma 64 to 960, alpha 0 to 1023. Transparent pixels are
/// black. @param rect  inside the image.
void convert_to_yuva444p10(const ImageView& image, const PixelRect& rect,
                           const YuvView<std::uint16_t>& picture);

/// 4:2:0 with 8 bits, chroma sited left, alpha 0 to 255 for each pixel. Alpha weighs the pixels of
/// a chroma sample too, so hidden colours do not tint an edge.
/// @param image of even width and height.
/// @param rect  inside the image; all its numbers are even. Chroma reads one column left of it.
void convert_to_yuva420(const ImageView& image, const PixelRect& rect,
                        const YuvView<std::uint8_t>& picture);

}  // namespace piblocks
