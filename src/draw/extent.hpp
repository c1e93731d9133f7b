// Where draw items are.
// In: an item. Out: an extent that it paints nothing out of.
#pragma once

#include <piblocks/image.hpp>

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

/// An item may paint so far out of its extent: Cairo rounds coordinates and sums to 1/256 pixel.
inline constexpr double kRounding_px = 1.0 / 64;

/// Small discs are painted at whole multiples of this.
inline constexpr double kDiscStep_px = 1.0 / 8;

/// Width of a line of text, in ems.
using MeasureText = std::function<double(Face face, std::string_view utf8)>;

/// From a disc's centre to the outside of its line.
double reach_of(const DiscItem& disc);

Rect extent_of(const ExposedBlock& block);
Rect extent_of(const MovingShape& moving);
/// The characters of a line of text between two distances from its origin.
Rect extent_of(const TextItem& text, double left_em, double right_em);
Rect extent_of(const DrawItem& item, const MeasureText& width_em);

/// Extents outside of which the path paints nothing: of a slanted line many small ones, since one
/// rectangle around it would be far larger.
std::vector<Rect> extents_of(const PathItem& path);

/// The whole pixels of an area that an extent, maybe far outside or not a number, reaches into.
PixelRect pixels_of(const Rect& extent, const PixelRect& area);

/// The pixels of an area that moving blocks reach into; of no width if nothing moves.
PixelRect moving_area(const ExposedBlocksItem& item, const PixelRect& area);

/// False only if the item has certainly painted nothing into the rectangle.
bool reaches(const DrawItem& item, const PixelRect& rect);

/// Whether every place and length is finite, in groups too. Items in plates were checked before.
bool are_finite(std::span<const DrawItem> items);

}  // namespace piblocks
