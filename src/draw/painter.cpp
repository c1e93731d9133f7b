#include "draw/painter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/stop.hpp"
#include "draw/extent.hpp"

namespace piblocks {
namespace {

/// Cairo's pixels are multiplied by their alpha.
CairoSurfacePtr premultiplied(const Image& image) {
  CairoSurfacePtr surface =
      image_surface(CAIRO_FORMAT_ARGB32, image.width_px, image.height_px, "paint a picture");
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

/// Whether the plates have the same pixels, wherever they are.
bool has_same_pixels(const PlateItem& a, const PlateItem& b) {
  return a.bounds.width == b.bounds.width && a.bounds.height == b.bounds.height &&
         a.bounds.x - a.origin.x == b.bounds.x - b.origin.x &&
         a.bounds.y - a.origin.y == b.bounds.y - b.origin.y && *a.plate == *b.plate;
}

/// These pixels were painted last now.
template <typename Kept>
cairo_surface_t& use(std::vector<Kept>& all, typename std::vector<Kept>::iterator kept) {
  std::rotate(kept, kept + 1, all.end());
  return *all.back().pixels;
}

/// A long film does not need any more what it has not shown for the longest time.
template <typename Kept>
cairo_surface_t& keep(std::vector<Kept>& all, Kept added) {
  constexpr std::size_t kMostKept = 40;
  if (all.size() == kMostKept) all.erase(all.begin());
  all.push_back(std::move(added));
  return *all.back().pixels;
}

double nearest_place(double px) { return std::round(px / kDiscStep_px) * kDiscStep_px; }

}  // namespace

bool has_pixels_of_picture(cairo_t& cr) {
  cairo_matrix_t matrix;
  cairo_get_matrix(&cr, &matrix);
  const bool is_identity = matrix.xx == 1 && matrix.yy == 1 && matrix.xy == 0 && matrix.yx == 0 &&
                           matrix.x0 == 0 && matrix.y0 == 0;
  return is_identity && has_pixels(cr);
}

bool is_small(const DiscItem& disc) {
  constexpr double kSmall_px = 32;
  return reach_of(disc) <= kSmall_px;
}

void copy_pixels(cairo_t& cr, cairo_surface_t& pixels, const Rect& bounds) {
  cairo_set_source_surface(&cr, &pixels, bounds.x, bounds.y);
  add_rectangle(cr, bounds);
  cairo_fill(&cr);
}

Painter::Painter(TextSetting setting) : setting_(setting) {}

void Painter::paint(cairo_t& cr, const DrawList& list) {
  paint(cr, list, {0, 0, list.width_px, list.height_px});
}

void Painter::paint(cairo_t& cr, const DrawList& list, const PixelRect& area) {
  if (list.background) {
    set_color(cr, *list.background);
    cairo_paint(&cr);
  }
  for (const DrawItem& item : list.items) {
    check_stop(stop_);
    if (!reaches(item, area)) continue;
    paint_item(cr, item, area);
  }
  check_cairo(cairo_status(&cr), "paint");
}

void Painter::paint_item(cairo_t& cr, const DrawItem& item, const PixelRect& area) {
  const auto paint_any = [&](const auto& any) {
    if constexpr (requires { this->paint(cr, any, area); }) {
      this->paint(cr, any, area);
    } else if constexpr (requires { this->paint(cr, any); }) {
      this->paint(cr, any);
    } else {
      paint_shape(cr, any);
    }
  };
  std::visit(paint_any, item);
}

void Painter::paint(cairo_t& cr, const TextItem& item) {
  set_color(cr, item.color);
  Point origin = item.origin;
  for (const auto& [font, text] : font(item.face).runs(item.text)) {
    font->select(cr, item.size_px);
    if (setting_ == TextSetting::lines) {
      cairo_move_to(&cr, origin.x, origin.y);
      cairo_show_text(&cr, std::string(text).c_str());
      cairo_new_path(&cr);  // else the next one would begin where the text ends
    } else {
      for (const cairo_glyph_t& glyph : Font::glyphs(cr, origin, text)) {
        cairo_show_glyphs(&cr, &glyph, 1);
      }
    }
    if (text.size() < item.text.size()) origin.x += font->width_em(text) * item.size_px;
  }
}

void Painter::paint(cairo_t& cr, const DiscItem& item) {
  if (!is_small(item) || !has_pixels_of_picture(cr)) return paint_shape(cr, item);
  const Point place{nearest_place(item.centre.x), nearest_place(item.centre.y)};
  const Point pixel{std::floor(place.x), std::floor(place.y)};
  const int reach_px = static_cast<int>(std::ceil(reach_of(item))) + 1;
  const DiscItem disc{ItemId{},
                      {reach_px + place.x - pixel.x, reach_px + place.y - pixel.y},
                      item.radius,
                      item.fill,
                      item.stroke};
  const int side_px = 2 * reach_px + 1;
  auto kept = std::ranges::find(discs_, disc, &Kept<DiscItem>::source);
  if (kept == discs_.end()) {
    constexpr std::size_t kMostKept = 256;
    if (discs_.size() == kMostKept) discs_.clear();
    CairoSurfacePtr pixels = image_surface(CAIRO_FORMAT_ARGB32, side_px, side_px, "paint a disc");
    paint_shape(*CairoPtr(cairo_create(pixels.get())), disc);
    discs_.push_back({disc, std::move(pixels)});
    kept = discs_.end() - 1;
  }
  copy_pixels(cr, *kept->pixels,
              {pixel.x - reach_px, pixel.y - reach_px, double(side_px), double(side_px)});
}

/// Pixel by pixel: Cairo's gradients are not the same on every processor.
void Painter::paint(cairo_t& cr, const GlowItem& item) {
  if (!has_pixels(cr)) return paint_shape(cr, item);
  const Rect& bounds = item.bounds;
  Image light{static_cast<int>(bounds.width), static_cast<int>(bounds.height), {}};
  const Color& color = item.color;
  const std::uint32_t rgb =
      std::uint32_t{color.red} << 16 | std::uint32_t{color.green} << 8 | color.blue;
  for (int y = 0; y < light.height_px; ++y) {
    for (int x = 0; x < light.width_px; ++x) {
      const Point pixel{bounds.x + x + 0.5, bounds.y + y + 0.5};
      const double distance = length(pixel - item.centre) / item.radius;
      const double alpha = std::round(color.alpha * GlowItem::strength(distance));
      light.words.push_back(static_cast<std::uint32_t>(alpha) << 24 | rgb);
    }
  }
  copy_pixels(cr, *premultiplied(light), bounds);
}

void Painter::paint(cairo_t& cr, const ImageItem& item) {
  cairo_surface_t& pixels = kept_pixels(item.image);
  cairo_save(&cr);
  cairo_translate(&cr, item.bounds.x, item.bounds.y);
  cairo_scale(&cr, item.bounds.width / item.image->width_px,
              item.bounds.height / item.image->height_px);
  // Not cairo_paint(): an enlarged picture would reach out of its bounds.
  copy_pixels(cr, pixels, {0, 0, double(item.image->width_px), double(item.image->height_px)});
  cairo_restore(&cr);
}

void Painter::paint(cairo_t& cr, const PlateItem& item) {
  if (setting_ == TextSetting::lines) {
    cairo_save(&cr);
    cairo_translate(&cr, item.origin.x, item.origin.y);
    for (const DrawItem& inner : item.plate->items) paint_item(cr, inner, {});
    cairo_restore(&cr);
    return;
  }
  copy_pixels(cr, kept_pixels(item), item.bounds);
}

CairoSurfacePtr Painter::pixels_of(const PlateItem& item) {
  CairoSurfacePtr pixels = image_surface(CAIRO_FORMAT_ARGB32, static_cast<int>(item.bounds.width),
                                         static_cast<int>(item.bounds.height), "paint a plate");
  cairo_surface_set_device_offset(pixels.get(), item.origin.x - item.bounds.x,
                                  item.origin.y - item.bounds.y);
  const CairoPtr inner(cairo_create(pixels.get()));
  for (const DrawItem& one : item.plate->items) paint_item(*inner, one, {});
  check_cairo(cairo_status(inner.get()), "paint a plate");
  cairo_surface_set_device_offset(pixels.get(), 0, 0);
  return pixels;
}

cairo_surface_t& Painter::kept_pixels(const PlateItem& item) {
  const auto kept = std::ranges::find(plates_, item.plate.get(),
                                      [](const KeptPlate& one) { return one.source.plate.get(); });
  if (kept != plates_.end()) return use(plates_, kept);
  // The plate of another run may have the same items, as after a change of the scene.
  const auto equal = std::ranges::find_if(
      plates_, [&](const KeptPlate& one) { return has_same_pixels(one.source, item); });
  if (equal == plates_.end()) return keep(plates_, KeptPlate{item, pixels_of(item)});
  equal->source = item;
  return use(plates_, equal);
}

cairo_surface_t& Painter::kept_pixels(const std::shared_ptr<const Image>& image) {
  const auto kept = std::ranges::find(images_, image, &KeptImage::source);
  if (kept != images_.end()) return use(images_, kept);
  return keep(images_, KeptImage{image, premultiplied(*image)});
}

/// A vector file can only paint a group over what is behind it.
void Painter::paint(cairo_t& cr, const GroupItem& item, const PixelRect& area) {
  const Rect& bounds = item.bounds;
  if (is_on_pixels(item) && has_pixels_of_picture(cr)) {
    paint_group_pixels(cr, item, area);
    return;
  }
  const double scale = bounds.width / item.list->width_px;
  cairo_save(&cr);
  add_rectangle(cr, bounds);
  cairo_clip(&cr);
  cairo_translate(&cr, bounds.x, bounds.y);
  cairo_scale(&cr, scale, scale);
  if (item.opacity < 1) cairo_push_group(&cr);
  paint(cr, *item.list);
  if (item.opacity < 1) {
    cairo_pop_group_to_source(&cr);
    cairo_paint_with_alpha(&cr, item.opacity);
  }
  cairo_restore(&cr);
}

/// Paints the visible area as a picture of its own: under a clip Cairo would paint other pixels.
void Painter::paint_group_pixels(cairo_t& cr, const GroupItem& item, const PixelRect& area) {
  const DrawList& list = *item.list;
  const int x = static_cast<int>(item.bounds.x);
  const int y = static_cast<int>(item.bounds.y);
  const int left = std::max(0, area.x_px - x);
  const int top = std::max(0, area.y_px - y);
  const int width = std::min(list.width_px, area.right_px() - x) - left;
  const int height = std::min(list.height_px, area.bottom_px() - y) - top;
  if (width <= 0 || height <= 0) return;
  // As for a canvas, Cairo must not know that the memory is clear.
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
    cairo_rectangle(&cr, x + left, y + top, width, height);
    cairo_fill(&cr);
    cairo_set_operator(&cr, CAIRO_OPERATOR_ADD);
  }
  cairo_set_source_surface(&cr, pixels.get(), x, y);
  cairo_pattern_set_filter(cairo_get_source(&cr), CAIRO_FILTER_NEAREST);
  cairo_paint_with_alpha(&cr, item.opacity);
  cairo_set_operator(&cr, CAIRO_OPERATOR_OVER);
  // The context must not keep a source whose memory ends here.
  cairo_set_source_rgb(&cr, 0, 0, 0);
}

void Painter::paint_still(cairo_t& cr, ItemId id, const ExposedBlock& block) {
  std::vector<DrawItem> still;
  add_rectangles(id, block, still);
  for (const DrawItem& rectangle : still) paint_item(cr, rectangle, {});
}

void Painter::paint_still(cairo_t& cr, const MovingShapesItem& item) {
  for (const MovingShape& moving : item.shapes) {
    if (const auto* block = std::get_if<ExposedBlock>(&moving.shape)) {
      paint_still(cr, item.id, *block);
    } else {
      paint(cr, std::get<DiscItem>(moving.shape));
    }
  }
}

const Light& Painter::light() {
  if (!light_) light_ = std::make_unique<Light>();
  return *light_;
}

}  // namespace piblocks
