// Draw list -> Cairo, the same for pixels, SVG and PDF.
// In: a context of any surface and a draw list. Out: marks on the surface.
#pragma once

#include <cairo.h>
#include <piblocks/draw_list.hpp>

#include <memory>

#include "draw/font.hpp"

namespace piblocks {

/// Holds the font, which is loaded when the first text is met.
class Painter {
 public:
  /// Paints the background and every item. @throws DrawError
  void paint(cairo_t& cr, const DrawList& list);

 private:
  void paint_text(cairo_t& cr, const TextItem& item);

  std::unique_ptr<Font> font_;
};

}  // namespace piblocks
