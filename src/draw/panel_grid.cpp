#include "draw/panel_grid.hpp"

#include <algorithm>
#include <tuple>

namespace piblocks {
namespace {

/// A narrower one may have no room for its title.
constexpr double kTitledPanel_em = 10;
/// The width of a diagram that looks best, in parts of its height.
constexpr double kPanelAspect = 1.6;

}  // namespace

std::vector<Rect> panel_grid(std::size_t count, const Rect& area, double gap, double em) {
  const auto side = [gap](double length, std::size_t n) {
    return (length - gap * double(n - 1)) / double(n);
  };
  const auto cell = [&](std::size_t columns) {
    const std::size_t rows = (count + columns - 1) / columns;
    return Rect{0, 0, side(area.width, columns), side(area.height, rows)};
  };
  const auto size = [em](const Rect& r) {
    return std::tuple(std::min(r.width, r.height) >= kLeastPanel_em * em,
                      r.width >= kTitledPanel_em * em, std::min(r.width / kPanelAspect, r.height));
  };
  std::size_t best = 1;
  for (std::size_t columns = 2; columns <= count; ++columns) {
    if (size(cell(columns)) > size(cell(best))) best = columns;
  }
  std::vector<Rect> cells(count, cell(best));
  for (std::size_t i = 0; i < count; ++i) {
    Rect& place = cells[i];
    const std::size_t row = i / best;
    // A last row that is not full is centred.
    const std::size_t in_row = std::min(best, count - row * best);
    const double shift = double(best - in_row) * (place.width + gap) / 2;
    place.x = area.x + shift + double(i % best) * (place.width + gap);
    place.y = area.y + double(row) * (place.height + gap);
  }
  return cells;
}

}  // namespace piblocks
