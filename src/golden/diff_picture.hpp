// Differences to look at.
// In: two pictures of one size, and how much each pixel differs. Out: a third that shows where they
// differ, or all three in a row.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <vector>

namespace piblocks {

/// The reference, pale and grey; red where anything differs, the stronger the more.
/// @param deltas  what pixel_deltas() returns.
Image difference_picture(const Image& reference, const std::vector<std::uint8_t>& deltas);

/// Expected, difference, actual, from left to right. Of pictures so wide that three do not fit into
/// a PNG file of kMaxSide_px, a part around `focus` is shown.
Image difference_strip(const Image& reference, const std::vector<std::uint8_t>& deltas,
                       const Image& actual, const PixelRect& focus);

}  // namespace piblocks
