#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/rounded.hpp"
#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/overlays/stage_parts.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

/// Above the ids of a block's bars.
constexpr std::size_t kCover = 1000;
constexpr double kWallAbove = 0.03;  ///< of the taller block

/// The heavier block's height, in heights of the lighter one.
double height_ratio(const BlockSystem& system) {
  const auto [light, heavy] = std::minmax(system.blue.mass, system.red.mass);
  const Magnitude ratio = magnitude_of(heavy / light);
  const double logarithm = rounded::log10(ratio.mantissa) + double(ratio.exponent);
  return std::min(style::kMaxHeightRatio, 1 + kHeightByMass * logarithm);
}

/// What is seen of the axis, and where.
struct Axis {
  Axis(const Scene& scene, const Rectangle& area)
      // Nothing is drawn behind the wall's face.
      : range{std::max(scene.view.x.low, scene.system.wall_face), scene.view.x.high} {
    if (range.high <= range.low) {
      throw UsageError(fmt::format(
          "view.x: ends at {}, and the wall's face is at {}; raise its upper end, or move the wall",
          to_text(range.high), to_text(scene.system.wall_face)));
    }
    const Sizes sizes(scene.view);
    const bool has_wall = shows_wall(scene);
    left_px = area.x + (has_wall ? sizes.margin + style::kWallWidth * sizes.short_side : 0);
    const double right = area.x + area.width - (has_wall ? sizes.margin : 0);
    scale = (right - left_px) / to_double(range.high - range.low);
    if (scale < kLeastRounded_px) return;
    scale = 2 * std::floor(scale / 2);
    left_px = std::round(left_px);
  }

  Range range;
  double left_px = 0;  ///< of its lower end
  double scale = 1;    ///< pixels per unit
};

void set_shapes(const BlockSystem& system, Layout& layout) {
  layout.blue.width = to_double(system.blue.width);
  layout.red.width = to_double(system.red.width);
  const bool is_red_heavy = system.red.mass >= system.blue.mass;
  BlockShape& light = is_red_heavy ? layout.blue : layout.red;
  BlockShape& heavy = is_red_heavy ? layout.red : layout.blue;
  light.height_px = light.width * layout.scale;
  heavy.height_px = light.height_px * height_ratio(system);
}

/// Makes both blocks lower until the taller one has room. @throws UsageError if there is too little
void fit_heights(double room_px, const View& view, Layout& layout) {
  if (room_px < kLeastHeight * Sizes(view).short_side) {
    throw UsageError(fmt::format(
        "show: the blocks would be {:.0f} pixels high in {}x{}; leave something out, or make the "
        "frame larger",
        std::max(0.0, room_px), view.width_px, view.height_px));
  }
  const double shrink = std::min(1.0, room_px / (layout.floor_px - layout.top_px()));
  for (BlockShape* block : {&layout.blue, &layout.red}) {
    block->height_px = std::max(1.0, std::floor(block->height_px * shrink));
  }
}

Rectangle around(const WallPlace& wall, const Sizes& sizes) {
  const double width = style::kWallWidth * sizes.short_side;
  return {wall.face_px - width - 1, wall.top_px - 1, width + 2, wall.bottom_px - wall.top_px + 2};
}

}  // namespace

Rational twice_energy(const BlockSystem& system) {
  return system.blue.mass * system.blue.velocity * system.blue.velocity +
         system.red.mass * system.red.velocity * system.red.velocity;
}

void check_resolution(const View& view, double scale) {
  const double farthest =
      std::max(std::abs(to_double(view.x.low)), std::abs(to_double(view.x.high)));
  const double step_px = farthest * std::numeric_limits<double>::epsilon() * scale;
  if (step_px <= kMostStep_px) return;
  throw UsageError(
      fmt::format("view.x: so far from 0 positions are {:.1e} apart, which would be {:.1f} pixels; "
                  "show more of the axis, or move wall, blocks and view towards 0",
                  step_px / scale, step_px));
}

double reach_px(const Scene& scene, const CollisionLog& log) {
  if (!has_span(scene, log)) return scene.view.width_px;
  const Span span = span_of(scene, log);
  // Red comes nearer and nearer, and then goes farther and farther away.
  const double farthest =
      std::max(log.state_at(span.from).red.position, log.state_at(span.to).red.position);
  const Axis axis(scene, whole(scene.view));
  const double right = farthest + to_double(scene.system.red.width) / 2;
  return axis.left_px + (right - to_double(axis.range.low)) * axis.scale;
}

Layout lay_out_stage(const Scene& scene, const Rectangle& area, const Font& font,
                     bool is_floor_at_bottom) {
  const Sizes sizes(scene.view);
  const Axis axis(scene, area);
  Layout layout;
  const bool is_whole = area.width >= scene.view.width_px;
  layout.content_right_px = area.x + area.width - sizes.margin;
  layout.visible_right_px =
      is_whole ? scene.view.width_px : static_cast<int>(layout.content_right_px);
  layout.line_px = std::max(1.0, std::round(sizes.data_line));
  layout.scale = axis.scale;
  check_resolution(scene.view, layout.scale);

  const double below = sizes.wall_line + room_below_px(scene);
  set_shapes(scene.system, layout);
  double above = 0;
  double room = 0;
  do {
    above = room_above_px(scene, layout, font);
    room = area.height - below - std::max(kWallAbove * sizes.short_side, above);
    fit_heights(room, scene.view, layout);
    // If a block is now too low for its mass, the mass moves above it and needs room there.
  } while (room_above_px(scene, layout, font) > above);
  const double height = std::max(layout.blue.height_px, layout.red.height_px);
  // What is left over is above and below in equal parts.
  const double rest = is_floor_at_bottom ? 0 : (room - height) / 2;
  layout.floor_px = std::floor(area.y + area.height - below - rest);
  layout.origin = {axis.left_px - to_double(axis.range.low) * layout.scale, layout.floor_px};
  layout.above_px = layout.top_px() - area.y;
  layout.below_px = area.y + area.height - layout.floor_px;
  layout.wall_bottom_px = layout.floor_px + sizes.wall_line;
  return layout;
}

void add_blocks(const FrameState& shown, const Layout& layout, const Palette& palette,
                std::vector<DrawItem>& items) {
  ExposedBlock red = block_at(layout.at(layout.red, shown.state.bodies[1].position[0]), palette.red,
                              layout.line_px);
  ExposedBlock blue = block_at(layout.at(layout.blue, shown.state.bodies[0].position[0]),
                               palette.blue, layout.line_px);
  if (shown.exposure.empty()) {
    add_rectangles(ItemId::red_block, red, items);
    add_rectangles(ItemId::blue_block, blue, items);
  } else {
    const AxisPlace axis{layout.origin.x, layout.scale, double(layout.visible_right_px)};
    items.emplace_back(exposed_blocks(std::move(red), std::move(blue), axis, shown.exposure));
  }
}

Drawable stage(const DrawingContext& context, Drawable behind) {
  const Scene& scene = context.scene;
  const Layout& layout = context.layout;
  const Sizes& sizes = context.sizes;
  const double top = layout.top_px() - kWallAbove * sizes.short_side;
  std::vector<DrawItem> stays;
  double floor_left = 0;
  if (shows_wall(scene)) {
    const double face = layout.at(to_double(scene.system.wall_face), 0).x;
    const WallPlace place{face, top, layout.wall_bottom_px};
    stays.emplace_back(plate_of(ItemId::wall, around(place, sizes), wall_items(place, context)));
    floor_left = face - sizes.wall_line;
  }
  stays.emplace_back(RectangleItem{
      nth(ItemId::wall, 1),
      {floor_left, layout.floor_px, layout.content_right_px - floor_left, sizes.wall_line},
      context.palette.wall,
      std::nullopt});
  std::optional<RectangleItem> cover;
  const std::optional<Color> background = background_of(scene.view);
  if (background && layout.visible_right_px < scene.view.width_px) {
    cover = {nth(ItemId::blue_block, kCover),
             {layout.content_right_px, 0, scene.view.width_px - layout.content_right_px,
              double(scene.view.height_px)},
             background,
             std::nullopt};
  }
  return [stays, cover, layout, palette = context.palette, behind = std::move(behind)](
             const FrameState& shown, std::vector<DrawItem>& items) {
    items.insert(items.end(), stays.begin(), stays.end());
    if (behind) behind(shown, items);
    add_blocks(shown, layout, palette, items);
    // Beside the stage of a row is the counter, which blocks pass behind.
    if (cover) items.emplace_back(*cover);
  };
}

}  // namespace piblocks
