#include "draw/region.hpp"

#include <algorithm>
#include <utility>

namespace piblocks {

Region::Region(int width_px, int height_px)
    : width_cells_((width_px + kCell_px - 1) / kCell_px),
      rows_(static_cast<std::size_t>((height_px + kCell_px - 1) / kCell_px)) {
  cells_.resize(static_cast<std::size_t>(width_cells_) * rows_.size());
}

void Region::clear() {
  for (std::size_t y = 0; y < rows_.size(); ++y) {
    const auto [begin, end] = std::exchange(rows_[y], {});
    Box* const boxes = row(static_cast<int>(y));
    std::fill(boxes + begin, boxes + end, Box{});
  }
}

void Region::add(const PixelRect& rect) {
  const int end_x = rect.right_px();
  const int end_y = rect.bottom_px();
  if (rect.is_empty()) return;
  const int begin_column = rect.x_px / kCell_px;
  const int end_column = (end_x - 1) / kCell_px + 1;
  for (int y = rect.y_px / kCell_px; y * kCell_px < end_y; ++y) {
    const auto top = static_cast<std::uint8_t>(std::max(0, rect.y_px - y * kCell_px));
    const auto bottom = static_cast<std::uint8_t>(std::min(kCell_px, end_y - y * kCell_px));
    Columns& columns = rows_[static_cast<std::size_t>(y)];
    const bool is_empty = columns.begin == columns.end;
    columns = {is_empty ? begin_column : std::min(columns.begin, begin_column),
               std::max(columns.end, end_column)};
    for (int x = begin_column; x < end_column; ++x) {
      const auto left = static_cast<std::uint8_t>(std::max(0, rect.x_px - x * kCell_px));
      const auto right = static_cast<std::uint8_t>(std::min(kCell_px, end_x - x * kCell_px));
      Box& box = row(y)[x];
      box = box.right == 0 ? Box{left, top, right, bottom}
                           : Box{std::min(box.left, left), std::min(box.top, top),
                                 std::max(box.right, right), std::max(box.bottom, bottom)};
    }
  }
}

std::span<const PixelRect> Region::rects() {
  rects_.clear();
  above_.clear();
  for (std::size_t y = 0; y < rows_.size(); ++y) {
    here_.clear();
    add_row(static_cast<int>(y));
    std::swap(above_, here_);
  }
  return rects_;
}

void Region::add_row(int y_cells) {
  const auto [begin, end] = rows_[static_cast<std::size_t>(y_cells)];
  auto above = above_.begin();
  for (int x = begin; x < end; ++x) {
    if (row(y_cells)[x].right == 0) continue;
    const PixelRect rect = run(x, y_cells);
    above = std::find_if(above, above_.end(),
                         [&](std::size_t i) { return rects_[i].x_px >= rect.x_px; });
    const bool continues = above != above_.end() && rect.y_px == y_cells * kCell_px &&
                           rects_[*above].x_px == rect.x_px &&
                           rects_[*above].width_px == rect.width_px;
    const std::size_t index = continues ? *above : rects_.size();
    if (continues) {
      rects_[index].height_px += rect.height_px;
    } else {
      rects_.push_back(rect);
    }
    if (rect.bottom_px() == (y_cells + 1) * kCell_px) here_.push_back(index);
  }
}

PixelRect Region::run(int& x_cells, int y_cells) {
  const Box* const boxes = row(y_cells);
  const Box& first = boxes[x_cells];
  const int left = x_cells * kCell_px + first.left;
  const auto continues = [&](const Box& box, const Box& next) {
    return box.right == kCell_px && next.right > 0 && next.left == 0 && next.top == first.top &&
           next.bottom == first.bottom;
  };
  while (x_cells + 1 < width_cells_ && continues(boxes[x_cells], boxes[x_cells + 1])) ++x_cells;
  return {left, y_cells * kCell_px + first.top, x_cells * kCell_px + boxes[x_cells].right - left,
          first.bottom - first.top};
}

}  // namespace piblocks
