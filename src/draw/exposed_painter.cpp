#include "draw/exposed_painter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "draw/expose.hpp"
#include "draw/exposed_column.hpp"

namespace piblocks {
namespace {

/// Pixels from `begin` to `end`, not included.
struct Span {
  int begin = 0;
  int end = 0;

  bool has(int pixel) const { return pixel >= begin && pixel < end; }
};

Span pixels_between(double from, double to, int begin, int length) {
  const auto pixel = [&](double at) {
    return static_cast<int>(std::clamp(at, double(begin), double(begin + length)));
  };
  return {pixel(std::floor(from)), pixel(std::ceil(to))};
}

/// The columns into which a block reaches if it moves.
Span columns_of(const ExposedBlock& block, const PixelRect& part) {
  if (block.dwells.empty()) return {};
  return pixels_between(block.dwells.front().x, block.dwells.back().x + block.bounds.width,
                        part.x_px, part.width_px);
}

Span rows_of(const ExposedBlock& block, const PixelRect& part) {
  return pixels_between(block.bounds.y, block.bounds.y + block.bounds.height, part.y_px,
                        part.height_px);
}

Cover row_cover(const BlockTimes& block, int row) {
  return row_cover_of(row, block.block(), block.line_px());
}

/// The surface of a part of a picture, addressed by the picture's pixels.
class Words {
 public:
  Words(cairo_surface_t& surface, const PixelRect& part)
      : data_(cairo_image_surface_get_data(&surface)),
        stride_bytes_(cairo_image_surface_get_stride(&surface)),
        part_(part) {}

  std::uint32_t& at(int x, int y) const {
    return reinterpret_cast<std::uint32_t*>(data_ + std::ptrdiff_t{y - part_.y_px} *
                                                        stride_bytes_)[x - part_.x_px];
  }

 private:
  unsigned char* data_;
  std::ptrdiff_t stride_bytes_;
  PixelRect part_;
};

}  // namespace

PixelRect moving_area(const ExposedItem& item, const PixelRect& part) {
  PixelRect all{};
  for (const ExposedBlock* block : {&item.behind, &item.front}) {
    const Span columns = columns_of(*block, part);
    if (columns.begin >= columns.end) continue;
    const int begin = all.width_px > 0 ? std::min(all.x_px, columns.begin) : columns.begin;
    const int end = all.width_px > 0 ? std::max(all.x_px + all.width_px, columns.end) : columns.end;
    all.x_px = begin;
    all.width_px = end - begin;
  }
  // Where one moves, the other is painted with it.
  const Span behind = rows_of(item.behind, part);
  const Span front = rows_of(item.front, part);
  all.y_px = std::min(behind.begin, front.begin);
  all.height_px = std::max(behind.end, front.end) - all.y_px;
  return all;
}

std::vector<DrawItem> still_blocks(const ExposedItem& item) {
  std::vector<DrawItem> still;
  for (const ExposedBlock* block : {&item.behind, &item.front}) {
    if (block->dwells.empty()) add_rectangles(item.id, *block, still);
  }
  return still;
}

/// A pixel's value depends on the column and what is behind alone, so that a part of the picture
/// has the pixels of the whole. What stays is Cairo's but where the other one passes.
void ExposedPainter::paint(cairo_surface_t& surface, const PixelRect& part, const ExposedItem& item,
                           const PaintStill& paint_still) {
  const PixelRect area = moving_area(item, part);
  cairo_surface_flush(&surface);
  const Words words(surface, part);
  background_.clear();
  for (int x = area.x_px; x < area.x_px + area.width_px; ++x) {
    for (int y = area.y_px; y < area.y_px + area.height_px; ++y) {
      background_.push_back(words.at(x, y));
    }
  }
  for (const DrawItem& rectangle : still_blocks(item)) paint_still(rectangle);
  if (background_.empty()) return;

  cairo_surface_flush(&surface);
  ExposedColumn column(item, light_);
  std::vector<RowCover> rows;
  for (int y = area.y_px; y < area.y_px + area.height_px; ++y) {
    rows.push_back({row_cover(column.behind(), y), row_cover(column.front(), y)});
  }
  const Span behind = columns_of(item.behind, part);
  const Span front = columns_of(item.front, part);
  auto background = background_.begin();
  for (int x = area.x_px; x < area.x_px + area.width_px; ++x) {
    if (!behind.has(x) && !front.has(x)) {
      background += area.height_px;
      continue;
    }
    column.enter(x);
    for (int y = area.y_px; y < area.y_px + area.height_px; ++y, ++background) {
      const RowCover& row = rows[static_cast<std::size_t>(y - area.y_px)];
      words.at(x, y) = (*background & 0xFF000000U) | column.pixel(row, *background & 0xFFFFFFU);
    }
  }
  cairo_surface_mark_dirty(&surface);
}

}  // namespace piblocks
