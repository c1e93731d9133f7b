#include "draw/painter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

#include "draw/cairo_handles.hpp"
#include "draw/damage.hpp"

namespace piblocks {
namespace {

void set_color(cairo_t& cr, const Color& color) {
  cairo_set_source_rgb(&cr, color.red / 255.0, color.green / 255.0, color.blue / 255.0);
}

/// Dashes along one side, fitted so that a dash ends in each corner and the pattern looks the
/// same from both ends.
void stroke_side(cairo_t& cr, const Point& from, const Point& to, double dash_px) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const double periods = std::max(1.0, std::round((length / dash_px - 1) / 2));
  const double fitted = length / (2 * periods + 1);
  cairo_set_dash(&cr, &fitted, 1, 0);
  cairo_move_to(&cr, from.x, from.y);
  cairo_line_to(&cr, to.x, to.y);
  cairo_stroke(&cr);
}

void stroke_inside(cairo_t& cr, const Rectangle& bounds, const Stroke& stroke) {
  // A shape thinner than its stroke is all stroke.
  const double width_px = std::min({stroke.width_px, bounds.width, bounds.height});
  const double inset = width_px / 2;
  const double left = bounds.x + inset;
  const double top = bounds.y + inset;
  const double right = bounds.x + bounds.width - inset;
  const double bottom = bounds.y + bounds.height - inset;
  set_color(cr, stroke.color);
  cairo_set_line_width(&cr, width_px);
  if (stroke.dash_px <= 0 || width_px < stroke.width_px) {
    cairo_set_dash(&cr, nullptr, 0, 0);
    cairo_rectangle(&cr, left, top, right - left, bottom - top);
    cairo_stroke(&cr);
    return;
  }
  cairo_set_line_cap(&cr, CAIRO_LINE_CAP_SQUARE);
  stroke_side(cr, {left, top}, {right, top}, stroke.dash_px);
  stroke_side(cr, {right, top}, {right, bottom}, stroke.dash_px);
  stroke_side(cr, {right, bottom}, {left, bottom}, stroke.dash_px);
  stroke_side(cr, {left, bottom}, {left, top}, stroke.dash_px);
  cairo_set_line_cap(&cr, CAIRO_LINE_CAP_BUTT);
}

/// Cairo's coordinates end at 2^23 pixels, and beyond it they come back on the other side. No frame
/// and no line reaches as far as this.
double within_reach(double px) {
  constexpr double kFar_px = 1 << 22;
  return std::clamp(px, -kFar_px, kFar_px);
}

Rectangle within_reach(const Rectangle& r) {
  const double x = within_reach(r.x);
  const double y = within_reach(r.y);
  if (x == r.x && y == r.y && r.width <= kMaxSide_px && r.height <= kMaxSide_px) return r;
  return {x, y, within_reach(r.x + r.width) - x, within_reach(r.y + r.height) - y};
}

void paint_rectangle(cairo_t& cr, const RectangleItem& item) {
  const Rectangle bounds = within_reach(item.bounds);
  if (item.fill) {
    set_color(cr, *item.fill);
    cairo_rectangle(&cr, bounds.x, bounds.y, bounds.width, bounds.height);
    cairo_fill(&cr);
  }
  if (item.stroke) stroke_inside(cr, bounds, *item.stroke);
}

/// The fill of the current path, then its line, centred on it.
void fill_and_stroke(cairo_t& cr, const std::optional<Color>& fill,
                     const std::optional<Stroke>& stroke) {
  if (fill) {
    set_color(cr, *fill);
    cairo_fill_preserve(&cr);
  }
  if (stroke) {
    set_color(cr, stroke->color);
    cairo_set_line_width(&cr, stroke->width_px);
    cairo_set_dash(&cr, &stroke->dash_px, stroke->dash_px > 0 ? 1 : 0, 0);
    cairo_set_line_join(&cr, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_preserve(&cr);
    cairo_set_line_join(&cr, CAIRO_LINE_JOIN_MITER);
  }
  cairo_new_path(&cr);
}

void paint_path(cairo_t& cr, const PathItem& item) {
  for (const Point& point : item.points.view()) {
    cairo_line_to(&cr, within_reach(point.x), within_reach(point.y));
  }
  if (item.closed) cairo_close_path(&cr);
  fill_and_stroke(cr, item.fill, item.stroke);
}

void paint_disk(cairo_t& cr, const DiskItem& item) {
  cairo_arc(&cr, item.centre.x, item.centre.y, item.radius, 0, 2 * std::numbers::pi);
  cairo_close_path(&cr);
  fill_and_stroke(cr, item.fill, item.stroke);
}

/// Whether one pixel of the picture is one pixel of the surface. It is not in a vector file, and
/// not on a sheet, where the picture is scaled.
bool has_pixels_of_picture(cairo_t& cr) {
  cairo_matrix_t matrix;
  cairo_get_matrix(&cr, &matrix);
  const bool is_identity = matrix.xx == 1 && matrix.yy == 1 && matrix.xy == 0 && matrix.yx == 0 &&
                           matrix.x0 == 0 && matrix.y0 == 0;
  return is_identity && cairo_surface_get_type(cairo_get_target(&cr)) == CAIRO_SURFACE_TYPE_IMAGE;
}

/// Cairo's pixels are multiplied by their alpha.
CairoSurfacePtr premultiplied(const Image& image) {
  CairoSurfacePtr surface(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width_px, image.height_px));
  check_cairo(cairo_surface_status(surface.get()), "paint a picture");
  const int stride_bytes = cairo_image_surface_get_stride(surface.get());
  unsigned char* row = cairo_image_surface_get_data(surface.get());
  const std::uint32_t* from = image.words.data();
  for (int y = 0; y < image.height_px; ++y, row += stride_bytes) {
    auto* const to = reinterpret_cast<std::uint32_t*>(row);
    for (int x = 0; x < image.width_px; ++x) {
      const std::uint32_t word = *from++;
      const std::uint32_t alpha = word >> 24;
      const auto scaled = [&](int shift) {
        return ((((word >> shift) & 0xFF) * alpha + 127) / 255) << shift;
      };
      to[x] = (alpha << 24) | scaled(16) | scaled(8) | scaled(0);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

}  // namespace

void Painter::paint(cairo_t& cr, const DrawList& list) {
  paint(cr, list, {0, 0, list.width_px, list.height_px});
}

void Painter::paint(cairo_t& cr, const DrawList& list, const PixelRect& part) {
  if (list.background) {
    set_color(cr, *list.background);
    cairo_paint(&cr);
  }
  for (const DrawItem& item : list.items) {
    if (!reaches(item, part)) continue;
    if (const auto* group = std::get_if<GroupItem>(&item)) {
      paint_group(cr, *group, part);
    } else if (const auto* exposed = std::get_if<ExposedItem>(&item)) {
      paint_exposed(cr, *exposed, list, part);
    } else {
      paint_item(cr, item);
    }
  }
  check_cairo(cairo_status(&cr), "paint");
}

void Painter::paint_item(cairo_t& cr, const DrawItem& item) {
  // cairo_show_text() leaves the current point at the end of its line, and the next path would
  // begin there.
  cairo_new_path(&cr);
  if (const auto* rectangle = std::get_if<RectangleItem>(&item)) paint_rectangle(cr, *rectangle);
  if (const auto* text = std::get_if<TextItem>(&item)) paint_text(cr, *text);
  if (const auto* path = std::get_if<PathItem>(&item)) paint_path(cr, *path);
  if (const auto* disk = std::get_if<DiskItem>(&item)) paint_disk(cr, *disk);
  if (const auto* image = std::get_if<ImageItem>(&item)) paint_image(cr, *image);
  if (const auto* plate = std::get_if<PlateItem>(&item)) paint_plate(cr, *plate);
}

void Painter::paint_image(cairo_t& cr, const ImageItem& item) {
  cairo_surface_t& picture = picture_of(item.image, [&] { return premultiplied(*item.image); });
  cairo_save(&cr);
  cairo_translate(&cr, item.bounds.x, item.bounds.y);
  cairo_scale(&cr, item.bounds.width / item.image->width_px,
              item.bounds.height / item.image->height_px);
  cairo_set_source_surface(&cr, &picture, 0, 0);
  // Not painted: a picture that is enlarged would reach out of its bounds.
  cairo_rectangle(&cr, 0, 0, item.image->width_px, item.image->height_px);
  cairo_fill(&cr);
  cairo_restore(&cr);
}

void Painter::paint_plate(cairo_t& cr, const PlateItem& item) {
  if (setting_ == TextSetting::lines) {
    for (const DrawItem& inner : item.plate->items) paint_item(cr, inner);
    return;
  }
  cairo_surface_t& picture = picture_of(item.plate, [&] { return paint_apart(item); });
  cairo_set_source_surface(&cr, &picture, item.bounds.x, item.bounds.y);
  cairo_rectangle(&cr, item.bounds.x, item.bounds.y, item.bounds.width, item.bounds.height);
  cairo_fill(&cr);
}

CairoSurfacePtr Painter::paint_apart(const PlateItem& item) {
  CairoSurfacePtr picture(cairo_image_surface_create(CAIRO_FORMAT_ARGB32,
                                                     static_cast<int>(item.bounds.width),
                                                     static_cast<int>(item.bounds.height)));
  check_cairo(cairo_surface_status(picture.get()), "paint a plate");
  cairo_surface_set_device_offset(picture.get(), -item.bounds.x, -item.bounds.y);
  const CairoPtr inner(cairo_create(picture.get()));
  for (const DrawItem& part : item.plate->items) paint_item(*inner, part);
  check_cairo(cairo_status(inner.get()), "paint a plate");
  cairo_surface_set_device_offset(picture.get(), 0, 0);
  return picture;
}

cairo_surface_t& Painter::picture_of(std::shared_ptr<const void> thing,
                                     const std::function<CairoSurfacePtr()>& make) {
  for (const Picture& kept : pictures_) {
    if (kept.thing == thing) return *kept.pixels;
  }
  CairoSurfacePtr pixels = make();
  // Of a long film the oldest are of no use any more.
  constexpr std::size_t kMostPictures = 40;
  if (pictures_.size() == kMostPictures) pictures_.erase(pictures_.begin());
  pictures_.push_back({std::move(thing), std::move(pixels)});
  return *pictures_.back().pixels;
}

/// A vector file knows no other way than over what is behind.
void Painter::paint_group(cairo_t& cr, const GroupItem& item, const PixelRect& part) {
  if (has_pixels_of_picture(cr)) {
    paint_group_pixels(cr, item, part);
    return;
  }
  cairo_save(&cr);
  cairo_new_path(&cr);
  cairo_translate(&cr, item.x_px, item.y_px);
  cairo_rectangle(&cr, 0, 0, item.list->width_px, item.list->height_px);
  cairo_clip(&cr);
  if (item.opacity < 1) cairo_push_group(&cr);
  paint(cr, *item.list);
  if (item.opacity < 1) {
    cairo_pop_group_to_source(&cr);
    cairo_paint_with_alpha(&cr, item.opacity);
  }
  cairo_restore(&cr);
}

/// As a picture of its own, of which no more is made than is seen: under a clip Cairo would paint
/// other pixels.
void Painter::paint_group_pixels(cairo_t& cr, const GroupItem& item, const PixelRect& part) {
  const DrawList& list = *item.list;
  const int left = std::max(0, part.x_px - item.x_px);
  const int top = std::max(0, part.y_px - item.y_px);
  const int width = std::min(list.width_px, part.x_px + part.width_px - item.x_px) - left;
  const int height = std::min(list.height_px, part.y_px + part.height_px - item.y_px) - top;
  if (width <= 0 || height <= 0) return;
  // Memory that Cairo does not know to be clear, as that of a canvas.
  std::vector<std::uint32_t> words(std::size_t(width) * std::size_t(height));
  const CairoSurfacePtr pixels(cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(words.data()),
      list.background ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32, width, height, 4 * width));
  check_cairo(cairo_surface_status(pixels.get()), "paint a picture within a picture");
  cairo_surface_set_device_offset(pixels.get(), -left, -top);
  paint(*CairoPtr(cairo_create(pixels.get())), list, {left, top, width, height});
  if (!list.background) {
    cairo_set_operator(&cr, CAIRO_OPERATOR_DEST_OUT);
    cairo_set_source_rgba(&cr, 0, 0, 0, item.opacity);
    cairo_rectangle(&cr, item.x_px + left, item.y_px + top, width, height);
    cairo_fill(&cr);
    cairo_set_operator(&cr, CAIRO_OPERATOR_ADD);
  }
  cairo_set_source_surface(&cr, pixels.get(), item.x_px, item.y_px);
  cairo_pattern_set_filter(cairo_get_source(&cr), CAIRO_FILTER_NEAREST);
  cairo_paint_with_alpha(&cr, item.opacity);
  cairo_set_operator(&cr, CAIRO_OPERATOR_OVER);
  // What it was painted from ends here.
  cairo_set_source_rgb(&cr, 0, 0, 0);
}

void Painter::paint_exposed(cairo_t& cr, const ExposedItem& item, const DrawList& list,
                            const PixelRect& part) {
  if (!has_pixels_of_picture(cr)) {
    embed_exposed(cr, item, list);
    return;
  }
  if (!exposed_) exposed_ = std::make_unique<ExposedPainter>();
  exposed_->paint(*cairo_get_target(&cr), part, item,
                  [&](const DrawItem& rectangle) { paint_item(cr, rectangle); });
}

/// What moves has no outline: it is embedded as pixels of the picture, with what is behind it.
void Painter::embed_exposed(cairo_t& cr, const ExposedItem& item, const DrawList& list) {
  for (const DrawItem& rectangle : still_blocks(item)) paint_item(cr, rectangle);
  const PixelRect area = moving_part(item, {0, 0, list.width_px, list.height_px});
  if (area.width_px <= 0 || area.height_px <= 0) return;
  DrawList until = list;
  const auto is_item = [&](const DrawItem& other) {
    const auto* exposed = std::get_if<ExposedItem>(&other);
    return exposed != nullptr && *exposed == item;
  };
  until.items.erase(std::ranges::find_if(until.items, is_item) + 1, until.items.end());
  const CairoSurfacePtr pixels(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, area.width_px, area.height_px));
  cairo_surface_set_device_offset(pixels.get(), -area.x_px, -area.y_px);
  const CairoPtr into(cairo_create(pixels.get()));
  paint(*into, until, area);
  cairo_surface_set_device_offset(pixels.get(), 0, 0);
  cairo_set_source_surface(&cr, pixels.get(), area.x_px, area.y_px);
  cairo_rectangle(&cr, area.x_px, area.y_px, area.width_px, area.height_px);
  cairo_fill(&cr);
}

const Font& Painter::font() {
  if (!font_) font_ = std::make_unique<Font>();
  return *font_;
}

void Painter::paint_text(cairo_t& cr, const TextItem& item) {
  font().select(cr, item.size_px);
  set_color(cr, item.color);
  if (setting_ == TextSetting::lines) {
    cairo_move_to(&cr, item.origin.x, item.origin.y);
    cairo_show_text(&cr, item.text.c_str());
    return;
  }
  for (const cairo_glyph_t& glyph : Font::glyphs(cr, item.origin, item.text)) {
    cairo_show_glyphs(&cr, &glyph, 1);
  }
}

}  // namespace piblocks
