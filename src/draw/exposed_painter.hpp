// Paints two blocks that were exposed for a while.
// In: a draw item, and pixels with what is behind it. Out: those pixels with the blocks.
#pragma once

#include <cairo.h>
#include <piblocks/image.hpp>

#include <cstdint>
#include <functional>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/light.hpp"

namespace piblocks {

/// The pixels of an area that a moving block reaches into; of no width if nothing moves.
PixelRect moving_area(const ExposedItem& item, const PixelRect& area);

/// The blocks that stay, as rectangles.
std::vector<DrawItem> still_blocks(const ExposedItem& item);

class ExposedPainter {
 public:
  using PaintStill = std::function<void(const DrawItem& rectangle)>;

  /// @param surface      the pixels of this area of the picture
  /// @param paint_still  paints a rectangle onto the surface
  void paint(cairo_surface_t& surface, const PixelRect& area, const ExposedItem& item,
             const PaintStill& paint_still);

 private:
  Light light_;
  std::vector<std::uint32_t> background_;
};

}  // namespace piblocks
