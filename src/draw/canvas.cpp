#include "draw/canvas.hpp"

#include <fmt/format.h>
#include <ft2build.h>
#include <pixman.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include "draw/cairo_handles.hpp"
#include "draw/painter.hpp"
#include "draw/region.hpp"
#include FT_FREETYPE_H

namespace piblocks {
namespace {

/// By hand: Cairo knows when it has cleared a surface itself, and then paints on it in other ways.
void clear(unsigned char* corner, const PixelRect& rect, int stride_bytes) {
  for (int y = 0; y < rect.height_px; ++y) {
    std::memset(corner + std::ptrdiff_t{y} * stride_bytes, 0, std::size_t(rect.width_px) * 4);
  }
}

/// How Cairo rounds a slanted edge depends on where the surface ends. The pixels of rectangles,
/// text, plates and exposed blocks do not depend on it.
bool depends_on_surface(const DrawItem& item) {
  if (const auto* group = std::get_if<GroupItem>(&item)) {
    const bool is_scaled = group->bounds.width != group->list->width_px;
    return is_scaled || std::ranges::any_of(group->list->items, depends_on_surface);
  }
  return std::holds_alternative<PathItem>(item) || std::holds_alternative<DiskItem>(item) ||
         std::holds_alternative<ImageItem>(item);
}

}  // namespace

struct Canvas::Pixels {
  Pixels(int width_px, int height_px, Background background)
      : format(background == Background::transparent ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24),
        surface(cairo_image_surface_create(format, width_px, height_px)) {
    check_cairo(cairo_surface_status(surface.get()), "make a canvas");
  }

  cairo_format_t format;
  CairoSurfacePtr surface;
  Painter painter{TextSetting::glyphs};
  std::optional<DrawList> shown;
  Region region;
  std::vector<bool> is_in_region;  ///< by tile; kept for its memory

  /// Paints what is in the region, and nothing else that would change a pixel.
  void paint(const DrawList& list);

 private:
  void paint_rect(const DrawList& list, const PixelRect& rect);
  void paint_tiles(const DrawList& list);
};

void Canvas::Pixels::paint(const DrawList& list) {
  if (std::ranges::any_of(list.items, depends_on_surface)) {
    paint_tiles(list);
  } else {
    for (const PixelRect& rect : region) paint_rect(list, rect);
  }
}

/// Paints whole tiles of a fixed grid, so that the same pixels come out whatever the region is.
void Canvas::Pixels::paint_tiles(const DrawList& list) {
  constexpr int kTile_px = 64;
  const auto columns = static_cast<std::size_t>((list.width_px + kTile_px - 1) / kTile_px);
  const auto rows = static_cast<std::size_t>((list.height_px + kTile_px - 1) / kTile_px);
  is_in_region.assign(columns * rows, false);
  for (const PixelRect& rect : region) {
    for (int y = rect.y_px / kTile_px; y * kTile_px < rect.y_px + rect.height_px; ++y) {
      for (int x = rect.x_px / kTile_px; x * kTile_px < rect.x_px + rect.width_px; ++x) {
        is_in_region[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)] = true;
      }
    }
  }
  for (std::size_t tile = 0; tile < is_in_region.size(); ++tile) {
    if (!is_in_region[tile]) continue;
    const int left = static_cast<int>(tile % columns) * kTile_px;
    const int top = static_cast<int>(tile / columns) * kTile_px;
    paint_rect(list, {left, top, std::min(kTile_px, list.width_px - left),
                      std::min(kTile_px, list.height_px - top)});
  }
}

/// Paints the rectangle as a picture of its own that shares the memory of the whole. Under a clip
/// Cairo would take other paths, and its antialiased edges come out a step lighter or darker there.
void Canvas::Pixels::paint_rect(const DrawList& list, const PixelRect& rect) {
  cairo_surface_flush(surface.get());
  const int stride_bytes = cairo_image_surface_get_stride(surface.get());
  unsigned char* const corner = cairo_image_surface_get_data(surface.get()) +
                                std::ptrdiff_t{rect.y_px} * stride_bytes + 4 * rect.x_px;
  if (!list.background) clear(corner, rect, stride_bytes);
  const CairoSurfacePtr pixels(cairo_image_surface_create_for_data(corner, format, rect.width_px,
                                                                   rect.height_px, stride_bytes));
  cairo_surface_set_device_offset(pixels.get(), -rect.x_px, -rect.y_px);
  const CairoPtr cr(cairo_create(pixels.get()));
  painter.paint(*cr, list, rect);
  cairo_surface_finish(pixels.get());
  cairo_surface_mark_dirty(surface.get());
}

Canvas::Canvas(int width_px, int height_px, Background background)
    : pixels_(std::make_unique<Pixels>(width_px, height_px, background)) {}

Canvas::~Canvas() = default;

void Canvas::paint(const DrawList& list) {
  assert(list.width_px == view().width_px && list.height_px == view().height_px);
  assert(list.background || view().has_alpha);
  pixels_->region = {{0, 0, list.width_px, list.height_px}};
  pixels_->paint(list);
  pixels_->shown = list;
}

std::span<const PixelRect> Canvas::update(DrawList list) {
  if (!pixels_->shown) {
    paint(list);
    return pixels_->region;
  }
  pixels_->region = changed_region(*pixels_->shown, list, [this](std::string_view text) {
    return pixels_->painter.font().width_em(text);
  });
  pixels_->paint(list);
  pixels_->shown = std::move(list);
  return pixels_->region;
}

ImageView Canvas::view() const {
  cairo_surface_t* surface = pixels_->surface.get();
  return {cairo_image_surface_get_data(surface), cairo_image_surface_get_width(surface),
          cairo_image_surface_get_height(surface), cairo_image_surface_get_stride(surface),
          pixels_->format == CAIRO_FORMAT_ARGB32};
}

std::vector<std::string> draw_library_versions() {
  FT_Library library = nullptr;
  int major = 0;
  int minor = 0;
  int patch = 0;
  if (FT_Init_FreeType(&library) == 0) {
    FT_Library_Version(library, &major, &minor, &patch);
    FT_Done_FreeType(library);
  }
  return {fmt::format("cairo {}", cairo_version_string()),
          std::string("pixman ") + pixman_version_string(),
          fmt::format("freetype {}.{}.{}", major, minor, patch), "font " PIBLOCKS_FONT_NAME};
}

std::string painter_fingerprint() {
  return fmt::format("{}", fmt::join(draw_library_versions(), ", "));
}

}  // namespace piblocks
