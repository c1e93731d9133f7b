// Lines and circles as polygons.
// In: points, a width, a radius. Out: closed polygons in a Cairo context, to be filled by the
// non-zero rule. Cairo's own lines and circles differ from version to version, and with the sine of
// the C library. These take sums, products and square roots alone, which are the same everywhere.
#pragma once

#include <cairo.h>

#include <span>

#include "draw/draw_list.hpp"

namespace piblocks {

/// The outline of a line through the points, with round joints and, unless it is closed, flat ends.
/// @param dash_px  as Stroke; a closed line begins with a dash at the first point.
void add_line_outline(cairo_t& cr, std::span<const Point> points, bool closed, double width_px,
                      double dash_px);

/// Clockwise on the screen, or the other way round for a hole in such a circle.
enum class Winding { clockwise, counterclockwise };

void add_circle(cairo_t& cr, const Point& centre, double radius_px,
                Winding winding = Winding::clockwise);

}  // namespace piblocks
