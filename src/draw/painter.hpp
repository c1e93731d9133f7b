// Draw list -> Cairo, the same for pixels, SVG and PDF.
// In: a context of any surface and a draw list. Out: marks on the surface.
#pragma once

#include <cairo.h>
#include <piblocks/image.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "draw/cairo_calls.hpp"
#include "draw/draw_list.hpp"
#include "draw/font.hpp"
#include "draw/light.hpp"

namespace piblocks {

void set_color(cairo_t& cr, const Color& color);
void add_rectangle(cairo_t& cr, const Rect& r);

// The context has no current path, neither before nor after.
void paint_shape(cairo_t& cr, const RectangleItem& item);
void paint_shape(cairo_t& cr, const PathItem& item);
void paint_shape(cairo_t& cr, const DiscItem& item);
/// For vector files.
void paint_shape(cairo_t& cr, const GlowItem& item);

// Lines and circles as closed polygons, to be filled by the non-zero rule. Cairo's own differ from
// version to version, and with the sine of the C library. These take sums, products and square
// roots alone, which are the same everywhere.

/// The outline of a line through the points, with round joints and, unless it is closed, flat ends.
/// @param dash_px  as Stroke; a closed line begins with a dash at the first point.
void add_line_outline(cairo_t& cr, std::span<const Point> points, bool closed, double width_px,
                      double dash_px);

/// Clockwise on the screen, or the other way round for a hole in such a circle.
enum class Winding { clockwise, counterclockwise };

void add_circle(cairo_t& cr, const Point& centre, double radius_px,
                Winding winding = Winding::clockwise);

/// Fills a rectangle with a surface whose upper left corner is there.
void copy_pixels(cairo_t& cr, cairo_surface_t& pixels, const Rect& bounds);

/// Whether pixels of the picture are those of the surface: not in vector files and scaled groups.
bool has_pixels_of_picture(cairo_t& cr);

/// Vector files have lines, circles and gradients of their own.
bool has_pixels(cairo_t& cr);

/// Whether a disc has few pixels: they are painted once for each place within a pixel, and kept.
bool is_small(const DiscItem& disc);

/// How text is set. Cairo blends overlapping glyphs of a line differently, if both are visible: a
/// part of a picture would differ from the whole by a step of grey.
enum class TextSetting {
  lines,  ///< at once, so that it stays text in a file
  glyphs  ///< each glyph by itself, so that its pixels depend on nothing else
};

/// Where a surface holds the pixels of an area of the picture. While it lives Cairo does not paint.
class SurfacePixels {
 public:
  SurfacePixels(cairo_t& cr, const PixelRect& area)
      : surface_(flushed(*cairo_get_target(&cr))),
        area_(area),
        data_(cairo_image_surface_get_data(&surface_)),
        stride_bytes_(cairo_image_surface_get_stride(&surface_)) {}
  ~SurfacePixels() { cairo_surface_mark_dirty(&surface_); }
  SurfacePixels(const SurfacePixels&) = delete;
  SurfacePixels& operator=(const SurfacePixels&) = delete;

  std::uint32_t* at(int x, int y) const {
    return reinterpret_cast<std::uint32_t*>(data_ + (y - area_.y_px) * stride_bytes_) +
           (x - area_.x_px);
  }

 private:
  static cairo_surface_t& flushed(cairo_surface_t& surface) {
    cairo_surface_flush(&surface);
    return surface;
  }

  cairo_surface_t& surface_;
  PixelRect area_;
  unsigned char* data_;
  std::ptrdiff_t stride_bytes_;
};

/// Red, green and blue.
using Rgb = std::array<double, 3>;

/// Pixels [begin, end) of a row.
struct PixelRun {
  int begin = 0;
  int end = 0;
};

/// Keeps fonts, pixels of plates and images, and a table of light, once they were needed.
class Painter {
 public:
  explicit Painter(TextSetting setting);
  ~Painter() = default;
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// From now on painting throws Interrupted soon after the token asks for it.
  void listen(std::stop_token stop) { stop_ = std::move(stop); }
  /// Paints the background, if there is one, and every item. @throws DrawError
  void paint(cairo_t& cr, const DrawList& list);
  /// The same where only this area of the picture is visible.
  void paint(cairo_t& cr, const DrawList& list, const PixelRect& area);
  const Font& font(Face face) { return fonts_.of(face); }

 private:
  /// By the function of its type. @param area  as in paint()
  void paint_item(cairo_t& cr, const DrawItem& item, const PixelRect& area);
  void paint(cairo_t& cr, const TextItem& item);
  void paint(cairo_t& cr, const DiscItem& item);
  static void paint(cairo_t& cr, const GlowItem& item);
  void paint(cairo_t& cr, const ImageItem& item);
  void paint(cairo_t& cr, const PlateItem& item);
  void paint(cairo_t& cr, const GroupItem& item, const PixelRect& area);
  void paint(cairo_t& cr, const ExposedBlocksItem& item, const PixelRect& area);
  void paint(cairo_t& cr, const MovingShapesItem& item, const PixelRect& area);
  CairoSurfacePtr pixels_of(const PlateItem& item);
  /// The pixels of this plate, made when a plate of these items is painted first.
  cairo_surface_t& kept_pixels(const PlateItem& item);
  /// The pixels of this image, made when it is painted first.
  cairo_surface_t& kept_pixels(const std::shared_ptr<const Image>& image);
  void paint_group_pixels(cairo_t& cr, const GroupItem& item, const PixelRect& area);
  // At the picture's instant.
  void paint_still(cairo_t& cr, ItemId id, const ExposedBlock& block);
  void paint_still(cairo_t& cr, const MovingShapesItem& item);
  const Light& light();

  TextSetting setting_;
  Fonts fonts_;
  std::unique_ptr<Light> light_;
  std::vector<std::uint32_t> background_;  ///< of exposed blocks; kept for its memory
  std::stop_token stop_;
  /// Pixels of a source, which is held, so that its address stays its own.
  template <typename Source>
  struct Kept {
    Source source;
    CairoSurfacePtr pixels;
  };
  using KeptPlate = Kept<PlateItem>;
  using KeptImage = Kept<std::shared_ptr<const Image>>;
  // Those that were painted last are at the end.
  std::vector<KeptPlate> plates_;
  std::vector<KeptImage> images_;
  std::vector<Kept<DiscItem>> discs_;  ///< in their surfaces, without ids
};

}  // namespace piblocks
