// What changes from one picture to the next.
// In: two draw lists. Out: the region outside of which their pixels are equal.
// It knows items, not scenes: all that is drawn with stable ids is compared in the same way.
#pragma once

#include <piblocks/image.hpp>

#include <vector>

#include "draw/draw_list.hpp"
#include "draw/extent.hpp"

namespace piblocks {

/// Rectangles of whole pixels, inside the frame. They may overlap.
using Region = std::vector<PixelRect>;

/// Covers every pixel in which the pictures may differ. It is the whole frame if the lists have
/// neither the same ids nor rising ones.
Region changed_region(const DrawList& before, const DrawList& after, const MeasureText& width_em);

}  // namespace piblocks
