// How people are told of a difference, in words and in a picture.
// In: what was found about a frame or about all of them. Out: a line; a picture with red in it.
#pragma once

#include <piblocks/compare.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace piblocks {

/// What is found about a frame: "3 pixels differ, largest delta 200 of 255, first at x=10 y=20
/// (red) …", "missing", or why it cannot be read.
std::string difference_text(const FrameComparison& frame);

/// The frame's name and difference_text(); only the text if it has the name already.
std::string row_text(const FrameComparison& frame);

/// The summary of a comparison: "different: 3 of 12 frames differ, 1 missing".
std::string summary_text(const ComparisonJob& job, const ComparisonResult& result);

/// The reference in pale grey, on white where it is transparent, with red where pixels differ,
/// stronger where they differ more.
/// @param deltas  as pixel_deltas() returns them
Image difference_picture(const Image& reference, const std::vector<std::uint8_t>& deltas);

/// Expected, difference, actual, from left to right. If three pictures are wider than kMaxSide_px,
/// only a part around `focus` is shown.
Image difference_strip(const Image& reference, const std::vector<std::uint8_t>& deltas,
                       const Image& actual, const PixelRect& focus);

}  // namespace piblocks
