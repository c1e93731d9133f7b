// Files of shapes and text rather than pixels.
// In: the size of a picture, and what paints it. Out: the bytes of an SVG or PDF file.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace piblocks {

/// Called once, by the calling thread.
using PaintPicture = std::function<void(cairo_t& cr)>;

/// One unit a pixel. Equal pictures give equal bytes. @throws DrawError
std::vector<std::uint8_t> write_svg(int width_px, int height_px, const PaintPicture& paint);
/// A page of one point a pixel. @throws DrawError
std::vector<std::uint8_t> write_pdf(int width_px, int height_px, const PaintPicture& paint);

}  // namespace piblocks
