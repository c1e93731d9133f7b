// Pixels in memory, seen or owned.
// In: a canvas or a decoded file. Out: what every sink and every comparison reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace piblocks {

/// Largest width or height of a frame, in pixels.
inline constexpr int kMaxSide_px = 16384;
/// Largest number of pixels in a frame: 256 MiB at four bytes each.
inline constexpr std::int64_t kMaxFrame_px = 64LL * 1024 * 1024;

/// A read-only view of 8-bit sRGB pixels, rows from the top. The memory must outlive it.
/// A pixel is one native-endian 32-bit word 0xFFRRGGBB (bytes B, G, R, FF on little-endian); or, if
/// the view has alpha, 0xAARRGGBB with red, green and blue multiplied by alpha / 255 and rounded,
/// so that none of them is greater than alpha.
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width_px = 0;
  int height_px = 0;
  std::ptrdiff_t stride_bytes = 0;
  bool has_alpha = false;

  const std::uint8_t* row(int y) const noexcept { return data + y * stride_bytes; }
};

/// An image that owns its pixels: words 0xAARRGGBB, or with Y, Cb and Cr in place of R, G and B.
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint32_t> words = {};  ///< row by row

  ImageView view() const noexcept {
    return {reinterpret_cast<const std::uint8_t*>(words.data()), width_px, height_px,
            std::ptrdiff_t{4} * width_px};
  }
};

/// The same for samples of more than 8 bits: words 0xAAAARRRRGGGGBBBB.
struct DeepImage {
  int width_px = 0;
  int height_px = 0;
  int max_level = 65535;                  ///< of every sample, such as 1023 for 10 bits
  std::vector<std::uint64_t> words = {};  ///< row by row
};

/// A rectangle of whole pixels, from its top left corner.
struct PixelRect {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;

  constexpr int right_px() const noexcept { return x_px + width_px; }
  constexpr int bottom_px() const noexcept { return y_px + height_px; }
  constexpr bool is_empty() const noexcept { return width_px <= 0 || height_px <= 0; }

  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

}  // namespace piblocks
