// Comparison of pictures as their files pack them: only rows that differ are unpacked.
// In: two packed pictures. Out: the same as of compare() and pixel_deltas() for images.
#pragma once

#include <piblocks/compare.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include "media/png/packed_png.hpp"

namespace piblocks {

Difference compare(const PackedImage& reference, const PackedImage& actual,
                   const Tolerance& tolerance = {}, std::span<const PixelRect> masks = {});

std::vector<std::uint8_t> pixel_deltas(const PackedImage& reference, const PackedImage& actual,
                                       std::span<const PixelRect> masks = {},
                                       bool ignores_transparent = false);

}  // namespace piblocks
