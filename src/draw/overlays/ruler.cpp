#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

/// Fewer give no scale.
constexpr int kLeastFigures = 2;
constexpr double kLeastGap_em = 1.0;  ///< between figures
// In fractions of the frame's shorter side.
constexpr double kBelowBlocks = 0.012;  ///< where there is no floor
constexpr double kTickLength = 0.012;
constexpr double kBelowTick = 0.01;

}  // namespace

double room_below_px(const LayoutContext& context, const Layout& layout) {
  const Sizes& sizes = context.sizes;
  if (!context.scene.show.has(Overlay::ruler)) {
    return labelled_below(context, layout).empty() ? 0 : label_room_below_px(sizes);
  }
  const double figures = (kBelowBlocks + kTickLength + kBelowTick) * sizes.short_side;
  return std::max(kRulerRoom * sizes.short_side, figures + 2 * kHalfFigure_em * sizes.text);
}

Drawable ruler(const DrawingContext& context) {
  const Layout& layout = context.layout;
  const Scene& scene = context.scene;
  const Sizes& sizes = context.sizes;
  const double size_px = sizes.text;
  const bool has_floor = scene.view.theme != Theme::article;
  const double axis_px =
      layout.floor_px + (has_floor ? sizes.wall_line : kBelowBlocks * sizes.short_side);
  const double tick_end = axis_px + kTickLength * sizes.short_side;
  const double baseline = tick_end + kBelowTick * sizes.short_side + 2 * kHalfFigure_em * size_px;
  const double below_px = baseline - layout.floor_px;
  if (below_px > layout.below_px) {
    throw UsageError("show.overlays",
                     fmt::format("the ruler needs {:.0f} pixels below the blocks, and there are "
                                 "{:.0f}; leave out 'ruler', or make the frame higher",
                                 below_px, std::max(0.0, layout.below_px)),
                     exact_text(Overlay::ruler));
  }
  // Figures beside the foot of the wall are not below it.
  const bool are_below_wall = baseline - 2 * kHalfFigure_em * size_px > layout.wall_bottom_px;
  const Columns room = are_below_wall ? text_columns(context) : text_columns_between_walls(context);
  const Range range = seen_axis(scene.system, scene.view);
  const double left = to_double(range.low);
  const double right = to_double(range.high);
  const FigureAxis axis{
      .low = left, .high = right, .em = size_px / layout.scale, .gap_em = kLeastGap_em};
  const Ticks ticks =
      with_room_for_figures(ticks_of(left, right, kLeastGap_em * axis.em), axis, context.font);

  const Stroke stroke{context.palette.muted, sizes.grid_line};
  std::vector<DrawItem> items;
  const auto add_line = [&](const Point& from, const Point& to) {
    items.emplace_back(line_item({}, {from, to}, stroke));
  };
  add_line({layout.at(left, 0).x, axis_px}, {layout.at(right, 0).x, axis_px});
  int figures = 0;
  for (const double value : ticks.values) {
    const double x = layout.at(value, 0).x;
    add_line({x, axis_px}, {x, tick_end});
    const std::string text = tick_text(value, ticks.step);
    const double half_px = context.font.width_em(text) * size_px / 2;
    // Beside its mark it would name another place.
    if (x - half_px < room.left || x + half_px > room.right) continue;
    ++figures;
    items.emplace_back(TextItem{
        {}, {x - half_px, baseline}, text, size_px, context.palette.muted, context.font.face()});
  }
  if (figures < kLeastFigures) {
    throw UsageError("show.overlays",
                     "the ruler has no room for two of its figures; leave out 'ruler', make the "
                     "frame wider, or show another part of the x axis",
                     exact_text(Overlay::ruler));
  }
  for (std::size_t n = 0; n < items.size(); ++n) {
    std::visit([n](auto& item) { item.id = nth(ItemId::ruler, n); }, items[n]);
  }
  return unchanging(std::move(items));
}

}  // namespace piblocks
