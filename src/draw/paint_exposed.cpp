#include <algorithm>
#include <cmath>
#include <cstddef>

#include "draw/exposed_blocks.hpp"
#include "draw/painter.hpp"
#include "draw/region.hpp"

namespace piblocks {
namespace {

/// The pixels of an area that a moving block reaches into; of no width if nothing moves.
PixelRect moving_area(const ExposedItem& item, const PixelRect& area) {
  const PixelRect behind = pixels_of(extent_of(item.behind), area);
  const PixelRect front = pixels_of(extent_of(item.front), area);
  int left = area.x_px + area.width_px;
  int right = area.x_px;
  for (const auto& [block, pixels] : {std::pair(&item.behind, behind), {&item.front, front}}) {
    if (block->dwells.empty() || pixels.width_px <= 0) continue;
    left = std::min(left, pixels.x_px);
    right = std::max(right, pixels.x_px + pixels.width_px);
  }
  // Where one block moves, the other is painted with it.
  const int top = std::min(behind.y_px, front.y_px);
  const int bottom = std::max(behind.y_px + behind.height_px, front.y_px + front.height_px);
  return {left, top, std::max(0, right - left), bottom - top};
}

}  // namespace

void Painter::paint_exposed(cairo_t& cr, const ExposedItem& item, const DrawList& list,
                            const PixelRect& area) {
  if (has_pixels_of_picture(cr)) {
    paint_exposed_pixels(cr, item, area);
  } else {
    embed_exposed(cr, item, list);
  }
}

void Painter::paint_still_blocks(cairo_t& cr, const ExposedItem& item) {
  std::vector<DrawItem> still;
  for (const ExposedBlock* block : {&item.behind, &item.front}) {
    if (block->dwells.empty()) add_rectangles(item.id, *block, still);
  }
  for (const DrawItem& rectangle : still) paint_item(cr, rectangle);
}

/// A pixel depends on its column and its background alone, so that a part of the picture has the
/// pixels of the whole. Cairo paints a block that stays, except where the other one passes.
void Painter::paint_exposed_pixels(cairo_t& cr, const ExposedItem& item, const PixelRect& area) {
  cairo_surface_t* const surface = cairo_get_target(&cr);
  const PixelRect moving = moving_area(item, area);
  const int end_x = moving.x_px + moving.width_px;
  const int end_y = moving.y_px + moving.height_px;
  cairo_surface_flush(surface);
  unsigned char* const data = cairo_image_surface_get_data(surface);
  const std::ptrdiff_t stride_bytes = cairo_image_surface_get_stride(surface);
  const auto word = [&](int x, int y) -> std::uint32_t& {
    unsigned char* const row = data + (y - area.y_px) * stride_bytes;
    return reinterpret_cast<std::uint32_t*>(row)[x - area.x_px];
  };
  background_.clear();
  for (int x = moving.x_px; x < end_x; ++x) {
    for (int y = moving.y_px; y < end_y; ++y) background_.push_back(word(x, y));
  }
  paint_still_blocks(cr, item);
  if (background_.empty()) return;

  cairo_surface_flush(surface);
  if (!light_) light_ = std::make_unique<Light>();
  ExposedColumn column(item, *light_);
  std::vector<RowCover> rows;
  for (int y = moving.y_px; y < end_y; ++y) rows.push_back(column.row_cover(y));
  auto background = background_.begin();
  for (int x = moving.x_px; x < end_x; ++x) {
    if (!column.enter(x)) {
      background += moving.height_px;
      continue;
    }
    for (int y = moving.y_px; y < end_y; ++y, ++background) {
      const RowCover& row = rows[static_cast<std::size_t>(y - moving.y_px)];
      word(x, y) = (*background & 0xFF000000U) | column.pixel(row, *background & 0xFFFFFFU);
    }
  }
  cairo_surface_mark_dirty(surface);
}

/// Moving blocks have no outline: they are embedded as pixels, with what is behind them.
void Painter::embed_exposed(cairo_t& cr, const ExposedItem& item, const DrawList& list) {
  paint_still_blocks(cr, item);
  const PixelRect area = moving_area(item, {0, 0, list.width_px, list.height_px});
  if (area.width_px <= 0 || area.height_px <= 0) return;
  DrawList until = list;
  const auto is_item = [&](const DrawItem& other) {
    const auto* exposed = std::get_if<ExposedItem>(&other);
    return exposed != nullptr && *exposed == item;
  };
  until.items.erase(std::ranges::find_if(until.items, is_item) + 1, until.items.end());
  const CairoSurfacePtr pixels =
      image_surface(CAIRO_FORMAT_RGB24, area.width_px, area.height_px, "paint blocks that move");
  cairo_surface_set_device_offset(pixels.get(), -area.x_px, -area.y_px);
  paint(*CairoPtr(cairo_create(pixels.get())), until, area);
  cairo_surface_set_device_offset(pixels.get(), 0, 0);
  copy_pixels(cr, *pixels, to_rectangle(area));
}

}  // namespace piblocks
