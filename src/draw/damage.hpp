// What changes from one picture to the next, and what that takes to paint.
// In: two draw lists. Out: the rectangles outside of which their pixels are equal, and which items
// show in them.
// Knows items, not scenes: whatever is drawn with stable ids is compared in the same way.
#pragma once

#include <piblocks/image.hpp>

#include <functional>
#include <string_view>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

/// Width of a line of text, in ems.
using MeasureText = std::function<double(std::string_view utf8)>;

/// Rectangles of whole pixels, inside the frame, that cover every pixel in which the pictures may
/// differ. They may overlap. One for the whole frame if the lists are not of the same items in the
/// same order.
std::vector<PixelRect> damage(const DrawList& before, const DrawList& after,
                              const MeasureText& width_em);

/// Whether the item may have painted something into the rectangle; no promise that it has.
bool reaches(const DrawItem& item, const PixelRect& rect);

}  // namespace piblocks
