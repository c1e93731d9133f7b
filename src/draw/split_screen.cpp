#include "draw/split_screen.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/stage.hpp"
#include "draw/theme.hpp"

namespace piblocks {
namespace {

// In parts of the frame's short measure.
constexpr double kMargin = 0.045;
constexpr double kLineWidth = 0.0032;
/// Below this a cell shows nothing.
constexpr int kLeastCell_px = 8;

}  // namespace

SplitScreen::SplitScreen(const View& view, std::size_t count) {
  const Palette palette = palette_of(view.theme);
  empty_ = {view.width_px, view.height_px, background_of(view), {}};
  const bool is_wide = view.width_px > view.height_px;
  const int length = is_wide ? view.width_px : view.height_px;
  const int breadth = is_wide ? view.height_px : view.width_px;
  const double measure = short_measure({0, 0, double(view.width_px), double(view.height_px)});
  const int line_px = std::max(1, static_cast<int>(std::lround(kLineWidth * measure)));
  const int n = static_cast<int>(count);
  const auto place = [is_wide](int along, int across, int along_px, int across_px) {
    return is_wide ? PixelRect{along, across, along_px, across_px}
                   : PixelRect{across, along, across_px, along_px};
  };
  const int cell_px = (length - (n - 1) * line_px) / n;
  if (std::min(cell_px, breadth) < kLeastCell_px) {
    throw UsageError(fmt::format("compare: {} runs do not fit into {}x{}; make the frame larger",
                                 count, view.width_px, view.height_px));
  }
  const int margin = static_cast<int>(std::lround(kMargin * measure));
  for (int i = 0; i < n; ++i) {
    const int at = i * (cell_px + line_px);
    cells_.push_back(place(at, 0, cell_px, breadth));
    if (i + 1 == n) break;
    const PixelRect line = place(at + cell_px, margin, line_px, breadth - 2 * margin);
    empty_.items.emplace_back(RectangleItem{
        nth(ItemId::compared, static_cast<std::size_t>(i)),
        {double(line.x_px), double(line.y_px), double(line.width_px), double(line.height_px)},
        palette.grid,
        std::nullopt});
  }
}

DrawList SplitScreen::compose(std::vector<DrawList> pictures) const {
  DrawList list = empty_;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    list.items.emplace_back(GroupItem{nth(ItemId::compared, cells_.size() + i), cells_[i].x_px,
                                      cells_[i].y_px,
                                      std::make_shared<const DrawList>(std::move(pictures[i])), 1});
  }
  return list;
}

DrawList cross_fade(DrawList from, DrawList to, double opacity) {
  from.items.emplace_back(
      GroupItem{ItemId::fade, 0, 0, std::make_shared<const DrawList>(std::move(to)), opacity});
  return from;
}

}  // namespace piblocks
