// Rectangles, paths and disks -> Cairo.
// In: a context and an item. Out: its fill and its line on the context's surface.
#pragma once

#include <cairo.h>

#include "draw/draw_list.hpp"

namespace piblocks {

void set_color(cairo_t& cr, const Color& color);

// The context has no current path, neither before nor after.
void paint_shape(cairo_t& cr, const RectangleItem& item);
void paint_shape(cairo_t& cr, const PathItem& item);
void paint_shape(cairo_t& cr, const DiskItem& item);

}  // namespace piblocks
