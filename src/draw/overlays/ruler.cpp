#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

// In parts of the room below the blocks.
constexpr double kAxis = 0.25;
constexpr double kTickLength = 0.14;
constexpr double kFigureBaseline = 0.82;
constexpr double kFigureSize = 0.44;
constexpr double kLeastDown = 0.1;
constexpr double kLeastRulerRoom_px = 16;
/// Fewer give no scale.
constexpr int kLeastFigures = 2;
// In ems.
constexpr double kFigure_em = 2 * kHalfFigure_em;
constexpr double kTickLength_em = 0.45;
constexpr double kBelowTick_em = 0.3;
constexpr double kBelowWall_em = 0.15;
constexpr double kBesideWall_em = 0.25;
constexpr double kBesideEdge_em = 0.1;
/// Size of type below the wall, in parts of what would fill the room there.
constexpr double kFitting = 0.95;
/// Figures below the wall are not smaller than this part of the usual size.
constexpr double kLeastFigureShrink = 0.7;
constexpr double kLeastGap_em = 1.0;  // between figures

/// Heights of the ruler, in pixels from the frame's top, and its type.
struct Rows {
  double axis;
  double tick_end;
  double baseline;
  double size_px;
  bool are_below_wall;
};

/// Figures are below the wall's foot if there is room, so that one can be centred at its face.
/// Otherwise they are beside the wall. @throws UsageError if there is too little room.
Rows rows_of(const DrawingContext& context) {
  const Layout& layout = context.layout;
  const double base = base_of(context.scene.system);
  const double low = to_double(context.scene.view.y.low);
  const double top = layout.at(0, base).y;
  const double room_px = (base - low) * layout.scale + std::min(layout.below_px, context.text_px);
  if (room_px < kLeastRulerRoom_px) {
    throw UsageError(
        fmt::format("show.overlays: the ruler needs {} pixels below the blocks, and there are "
                    "{:.0f}; lower the lower end of view.y, or make the frame larger",
                    kLeastRulerRoom_px, std::max(0.0, room_px)));
  }
  const double usual_px = std::min(kFigureSize * room_px, context.text_px);
  const double fitting_px = (layout.below_px - layout.line_px) / (kBelowWall_em + kFigure_em);
  const double size_px = std::min(usual_px, kFitting * fitting_px);
  const double foot = layout.at(0, low).y;
  const double baseline = foot + layout.line_px + (kBelowWall_em + kFigure_em) * size_px;
  const double tick_end = baseline - (kFigure_em + kBelowTick_em) * size_px;
  const double axis = std::round(tick_end - kTickLength_em * size_px);
  const double least_px =
      std::max(kLeastFigureShrink * usual_px, std::min(usual_px, style::kLeastText_px));
  if (size_px >= least_px && axis > top + kLeastDown * room_px) {
    return {.axis = axis,
            .tick_end = tick_end,
            .baseline = baseline,
            .size_px = size_px,
            .are_below_wall = true};
  }
  const double above = std::round(top + kAxis * room_px);
  return {.axis = above,
          .tick_end = above + kTickLength * room_px,
          .baseline = above + (kFigureBaseline - kAxis) * room_px,
          .size_px = usual_px,
          .are_below_wall = false};
}

}  // namespace

Drawable ruler(const DrawingContext& context) {
  const Layout& layout = context.layout;
  const Scene& scene = context.scene;
  const Rows rows = rows_of(context);
  const double size_px = rows.size_px;
  const double left = to_double(std::max(scene.view.x.low, scene.system.wall_face));
  const double right = to_double(scene.view.x.high);
  const double wall_px = layout.at(to_double(scene.system.wall_face), 0).x;
  const double wall_end_px = rows.are_below_wall ? 0 : wall_px + kBesideWall_em * size_px;
  const double first_px = std::max(kBesideEdge_em * size_px, wall_end_px);
  const double end_px = scene.view.width_px - kBesideEdge_em * size_px;
  const FigureAxis axis{
      .low = left, .high = right, .em = size_px / layout.scale, .gap_em = kLeastGap_em};
  const Ticks ticks =
      with_room_for_figures(ticks_of(left, right, kLeastGap_em * axis.em), axis, context.font);

  const Stroke stroke{context.palette.muted, context.line_px};
  std::vector<DrawItem> items;
  const auto add_line = [&](const Point& from, const Point& to) {
    items.emplace_back(PathItem{{}, std::vector<Point>{from, to}, false, std::nullopt, stroke});
  };
  add_line({layout.at(left, 0).x, rows.axis}, {layout.at(right, 0).x, rows.axis});
  int figures = 0;
  for (const double value : ticks.values) {
    const double x = layout.at(value, 0).x;
    add_line({x, rows.axis}, {x, rows.tick_end});
    const std::string text = tick_text(value, ticks.step);
    const double half_px = context.font.width_em(text) * size_px / 2;
    // Beside its mark it would name another place.
    if (x - half_px < first_px || x + half_px > end_px) continue;
    ++figures;
    items.emplace_back(
        TextItem{{}, {x - half_px, rows.baseline}, text, size_px, context.palette.muted});
  }
  if (figures < kLeastFigures) {
    throw UsageError(
        "show.overlays: the ruler has no room for two of its figures; leave out 'ruler', make the "
        "frame wider, or show another part of the x axis");
  }
  for (std::size_t n = 0; n < items.size(); ++n) {
    std::visit([n](auto& item) { item.id = nth(ItemId::ruler, n); }, items[n]);
  }
  return unchanging(std::move(items));
}

}  // namespace piblocks
