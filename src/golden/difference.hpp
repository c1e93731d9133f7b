// How people are told of a difference, in words and in a picture.
// In: what was found about a frame or about all of them. Out: a line; a picture with red in it.
#pragma once

#include <piblocks/compare.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "media/output/bytes.hpp"

namespace piblocks {

/// What is found about a frame: "3 pixels differ, largest delta 200 of 255, first at x=10 y=20
/// (red) …", "missing", or why it cannot be read.
std::string difference_text(const FrameComparison& frame);

/// The frame's name and difference_text(); only the text if it has the name already.
std::string row_text(const FrameComparison& frame);

/// The summary of a comparison: "different: 3 of 12 frames differ, 1 missing".
std::string summary_text(const ComparisonJob& job, const ComparisonResult& result);

/// What the job accepts: "Samples may differ by up to 3 of 255, except in up to 40 pixels."
std::string tolerance_text(const ComparisonJob& job);

inline constexpr std::size_t kMaxRegions = 100;

/// Rectangles around all pixels that differ. They do not touch: those nearer than 16 pixels are
/// joined, and more distant ones where there would be more than kMaxRegions. Takes time in
/// proportion to the pixels.
/// @param deltas  as pixel_deltas() returns them
std::vector<PixelRect> changed_regions(std::span<const std::uint8_t> deltas, int width_px);

/// A PNG file: the reference in pale grey, on white where it is transparent, with red where pixels
/// differ, stronger where they differ more.
/// @param deltas  as pixel_deltas() returns them
Bytes difference_picture(const Image& reference, const std::vector<std::uint8_t>& deltas);

}  // namespace piblocks
