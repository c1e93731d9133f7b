#include "draw/overlays/stage_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace piblocks {
namespace {

/// In fractions of the frame's shorter side.
constexpr double kHatchStep = 0.02;
/// Distance from a block's edge to its first bar, and from bar to bar, in parts of its height.
constexpr double kBarSpacing = 0.1;

}  // namespace

bool shows_wall(const Scene& scene) {
  return scene.view.x.low <= scene.system.wall_face && scene.view.x.high > scene.system.wall_face;
}

ExposedBlock block_at(const Rectangle& bounds, const BlockColors& colors, double line_px) {
  ExposedBlock block{bounds, colors.fill, Stroke{colors.edge, line_px}, {}, {}};
  const double height = std::min(2 * line_px, kBarSpacing * bounds.height / 2);
  for (int bar = 1; bar <= colors.bars; ++bar) {
    const bool is_upper = 2 * bar <= colors.bars;
    const double down = kBarSpacing * (is_upper ? bar : bar - colors.bars - 1);
    const double centre = std::round(bounds.y + bounds.height * (is_upper ? down : 1 + down));
    block.bars.push_back({centre - height / 2, height});
  }
  return block;
}

PlateItem plate_of(ItemId id, const Rectangle& bounds, std::vector<DrawItem> items) {
  return {id, whole_pixels(bounds), std::make_shared<const Plate>(Plate{std::move(items)})};
}

std::vector<DrawItem> wall_items(const WallPlace& place, const DrawingContext& context) {
  const auto& [face_px, top_px, bottom] = place;
  const Sizes& sizes = context.sizes;
  const double width = style::kWallWidth * sizes.short_side;
  // The face hides the corners of the line's end.
  const double longest = std::max(width - sizes.wall_line / 2, width / 2);
  std::vector<DrawItem> items;
  const Stroke hatch{context.palette.muted, sizes.grid_line};
  for (double y = top_px; y < bottom + width; y += kHatchStep * sizes.short_side) {
    // From the face down to the left, cut off at the wall's ends.
    const double from = std::max(0.0, y - bottom);
    const double to = std::min(longest, y - top_px);
    if (to <= from) continue;
    // y is the height at the wall's left end plus its width.
    items.emplace_back(PathItem{
        nth(ItemId::wall, items.size()),
        std::vector<Point>{{face_px - width + to, y - to}, {face_px - width + from, y - from}},
        false, std::nullopt, hatch});
  }
  const Rectangle face{face_px - sizes.wall_line, top_px, sizes.wall_line, bottom - top_px};
  items.emplace_back(
      RectangleItem{nth(ItemId::wall, items.size()), face, context.palette.wall, std::nullopt});
  return items;
}

}  // namespace piblocks
