#include "draw/split_screen.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/style.hpp"
#include "draw/theme.hpp"

namespace piblocks {
namespace {

/// Below this a cell shows nothing.
constexpr int kLeastCell_px = 8;

Rectangle to_rectangle(const PixelRect& r) {
  return {double(r.x_px), double(r.y_px), double(r.width_px), double(r.height_px)};
}

}  // namespace

SplitScreen::SplitScreen(const View& view, std::size_t count)
    : empty_{view.width_px, view.height_px, background_of(view), {}} {
  const bool is_wide = view.width_px > view.height_px;
  const auto [breadth, length] = std::minmax({view.width_px, view.height_px});
  const int line_px = std::max(1, static_cast<int>(std::lround(line_width_px(view))));
  const int n = static_cast<int>(count);
  const int cell_px = (length - (n - 1) * line_px) / n;
  if (std::min(cell_px, breadth) < kLeastCell_px) {
    throw UsageError(fmt::format("compare: {} runs do not fit into {}x{}; make the frame larger",
                                 count, view.width_px, view.height_px));
  }
  const auto place = [is_wide](int along, int across, int along_px, int across_px) {
    return is_wide ? PixelRect{along, across, along_px, across_px}
                   : PixelRect{across, along, across_px, along_px};
  };
  const int margin = static_cast<int>(std::lround(style::kMargin * short_measure(view)));
  for (int i = 0; i < n; ++i) {
    const int at = i * (cell_px + line_px);
    cells_.push_back(place(at, 0, cell_px, breadth));
    if (i + 1 == n) break;
    empty_.items.emplace_back(
        RectangleItem{nth(ItemId::compared, static_cast<std::size_t>(i)),
                      to_rectangle(place(at + cell_px, margin, line_px, breadth - 2 * margin)),
                      palette_of(view.theme).grid, std::nullopt});
  }
}

DrawList SplitScreen::compose(std::vector<DrawList> pictures) const {
  DrawList list = empty_;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    list.items.emplace_back(GroupItem{nth(ItemId::compared, cells_.size() + i),
                                      to_rectangle(cells_[i]),
                                      std::make_shared<const DrawList>(std::move(pictures[i])), 1});
  }
  return list;
}

DrawList cross_fade(DrawList from, DrawList to, double opacity) {
  const Rectangle bounds{0, 0, double(to.width_px), double(to.height_px)};
  from.items.emplace_back(
      GroupItem{ItemId::fade, bounds, std::make_shared<const DrawList>(std::move(to)), opacity});
  return from;
}

}  // namespace piblocks
