// Draw list -> Cairo, the same for pixels, SVG and PDF.
// In: a context of any surface and a draw list. Out: marks on the surface.
#pragma once

#include <cairo.h>
#include <piblocks/image.hpp>

#include <functional>
#include <memory>
#include <vector>

#include "draw/cairo_handles.hpp"
#include "draw/draw_list.hpp"
#include "draw/exposed_painter.hpp"
#include "draw/font.hpp"

namespace piblocks {

/// How text is set. Of overlapping glyphs of one line Cairo blends all in another way than others,
/// and whether they overlap it asks only of those in view: a part of a picture would differ from
/// the whole by a step of grey.
enum class TextSetting {
  lines,  ///< at once, so that it stays text in a file
  glyphs  ///< each glyph by itself, so that its pixels depend on nothing else
};

/// Holds the font, which is loaded when the first text is met, the pixels of plates and images, and
/// a table of light, which is made for the first exposed item.
class Painter {
 public:
  explicit Painter(TextSetting setting) : setting_(setting) {}

  /// Paints the background, if there is one, and every item. @throws DrawError
  void paint(cairo_t& cr, const DrawList& list);
  /// The same where nothing but this part of the picture is seen.
  void paint(cairo_t& cr, const DrawList& list, const PixelRect& part);
  const Font& font();

 private:
  void paint_item(cairo_t& cr, const DrawItem& item);
  void paint_exposed(cairo_t& cr, const ExposedItem& item, const DrawList& list,
                     const PixelRect& part);
  void embed_exposed(cairo_t& cr, const ExposedItem& item, const DrawList& list);
  void paint_text(cairo_t& cr, const TextItem& item);
  void paint_image(cairo_t& cr, const ImageItem& item);
  void paint_plate(cairo_t& cr, const PlateItem& item);
  void paint_group(cairo_t& cr, const GroupItem& item, const PixelRect& part);
  void paint_group_pixels(cairo_t& cr, const GroupItem& item, const PixelRect& part);
  CairoSurfacePtr paint_apart(const PlateItem& item);
  /// What was made of this plate or image when it was painted first.
  cairo_surface_t& picture_of(std::shared_ptr<const void> thing,
                              const std::function<CairoSurfacePtr()>& make);

  TextSetting setting_;
  std::unique_ptr<Font> font_;
  std::unique_ptr<ExposedPainter> exposed_;
  /// The thing is kept too, so that no other one can come to be in its place in memory.
  struct Picture {
    std::shared_ptr<const void> thing;
    CairoSurfacePtr pixels;
  };
  std::vector<Picture> pictures_;
};

}  // namespace piblocks
