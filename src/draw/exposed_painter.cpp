#include "draw/exposed_painter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "draw/expose.hpp"
#include "draw/exposed_column.hpp"
#include "draw/extent.hpp"

namespace piblocks {
namespace {

/// The whole pixels of an area that a block reaches into while the picture is exposed.
PixelRect pixels_of(const ExposedBlock& block, const PixelRect& area) {
  const Extent extent = extent_of(block);
  const auto pixel = [](double at, int begin, int length) {
    return static_cast<int>(std::clamp(at, double(begin), double(begin + length)));
  };
  const int x = pixel(std::floor(extent.left), area.x_px, area.width_px);
  const int y = pixel(std::floor(extent.top), area.y_px, area.height_px);
  return {x, y, pixel(std::ceil(extent.right), area.x_px, area.width_px) - x,
          pixel(std::ceil(extent.bottom), area.y_px, area.height_px) - y};
}

}  // namespace

PixelRect moving_area(const ExposedItem& item, const PixelRect& area) {
  const PixelRect behind = pixels_of(item.behind, area);
  const PixelRect front = pixels_of(item.front, area);
  int left = area.x_px + area.width_px;
  int right = area.x_px;
  if (!item.behind.dwells.empty() && behind.width_px > 0) {
    left = behind.x_px;
    right = behind.x_px + behind.width_px;
  }
  if (!item.front.dwells.empty() && front.width_px > 0) {
    left = std::min(left, front.x_px);
    right = std::max(right, front.x_px + front.width_px);
  }
  // Where one block moves, the other is painted with it.
  const int top = std::min(behind.y_px, front.y_px);
  const int bottom = std::max(behind.y_px + behind.height_px, front.y_px + front.height_px);
  return {left, top, std::max(0, right - left), bottom - top};
}

std::vector<DrawItem> still_blocks(const ExposedItem& item) {
  std::vector<DrawItem> still;
  for (const ExposedBlock* block : {&item.behind, &item.front}) {
    if (block->dwells.empty()) add_rectangles(item.id, *block, still);
  }
  return still;
}

/// A pixel depends on its column and its background alone, so that a part of the picture has the
/// pixels of the whole. Cairo paints a block that stays, except where the other one passes.
void ExposedPainter::paint(cairo_surface_t& surface, const PixelRect& area, const ExposedItem& item,
                           const PaintStill& paint_still) {
  const PixelRect moving = moving_area(item, area);
  const int end_x = moving.x_px + moving.width_px;
  const int end_y = moving.y_px + moving.height_px;
  cairo_surface_flush(&surface);
  unsigned char* const data = cairo_image_surface_get_data(&surface);
  const std::ptrdiff_t stride_bytes = cairo_image_surface_get_stride(&surface);
  const auto word = [&](int x, int y) -> std::uint32_t& {
    unsigned char* const row = data + (y - area.y_px) * stride_bytes;
    return reinterpret_cast<std::uint32_t*>(row)[x - area.x_px];
  };
  background_.clear();
  for (int x = moving.x_px; x < end_x; ++x) {
    for (int y = moving.y_px; y < end_y; ++y) background_.push_back(word(x, y));
  }
  for (const DrawItem& rectangle : still_blocks(item)) paint_still(rectangle);
  if (background_.empty()) return;

  cairo_surface_flush(&surface);
  ExposedColumn column(item, light_);
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
  cairo_surface_mark_dirty(&surface);
}

}  // namespace piblocks
