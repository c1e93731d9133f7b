#include "draw/stage/stage.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace piblocks {
namespace {

/// Distance from a block's edge to its first bar, and from bar to bar, in parts of its height.
constexpr double kBarSpacing = 0.1;
/// Above the ids of a block's bars.
constexpr std::size_t kCover = 1000;
/// Above the ids of walls.
constexpr std::size_t kTrails = 2000;
constexpr double kTrailOpacity = 0.45;
/// Of video where nothing slows it down.
constexpr int kTrail_s = 2;
/// A disc whose radius is less than so many widths of its rim has none.
constexpr double kLeastRim = 4;

/// A block's id, from the last block to the first, which is in front. It leaves room for bars.
ItemId block_id(std::size_t body, std::size_t count) {
  constexpr std::size_t kWithBars = 8;
  constexpr std::size_t kFewBodies = 100;
  if (body == 0) return ItemId::blue_block;
  return nth(ItemId::red_block, (count - 1 - body) * (count <= kFewBodies ? kWithBars : 1));
}

/// Discs, at one instant or exposed, and where they have been.
class Discs {
 public:
  explicit Discs(const DrawingContext& context)
      : frame_{0, 0, context.scene.view.width_px, context.scene.view.height_px},
        layout_(context.layout),
        data_line_px_(context.sizes.data_line),
        colors_(context.colors) {}

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    add_trails(shown.trails, items);
    std::vector<PlacedBody> discs;
    discs.reserve(shown.state.bodies.size());
    for (std::size_t i = 0; i < shown.state.bodies.size(); ++i) {
      const DiscItem disc = disc_of(i, shown.state.bodies[i].position);
      discs.push_back({disc.id, i, disc});
    }
    add_exposed(discs, layout_, frame_, shown.exposure, items);
  }

 private:
  double radius_px(std::size_t body) const { return layout_.width_px(body) / 2; }

  /// Where themes tell blocks by their bars, discs have broader rims.
  double rim_px(std::size_t body) const {
    const double rim = layout_.line_px * (1 + colors_[body].bars);
    return radius_px(body) - layout_.line_px / 2 > kLeastRim * layout_.line_px
               ? std::min(rim, std::round(radius_px(body) / 2))
               : 0;
  }

  /// Lines behind discs. They end where the disc is.
  void add_trails(const std::vector<std::vector<PathPoint>>& trails,
                  std::vector<DrawItem>& items) const {
    for (std::size_t i = 0; i < trails.size(); ++i) {
      if (trails[i].empty()) continue;
      std::vector<Point> points;
      for (const PathPoint& point : trails[i]) points.push_back(layout_.at(point.position));
      const double width_px = std::min(std::max(1.0, radius_px(i) / 2), data_line_px_);
      items.emplace_back(line_item(nth(ItemId::wall, kTrails + i), std::move(points),
                                   {faded(colors_[i].fill, kTrailOpacity), width_px}));
    }
  }

  DiscItem disc_of(std::size_t body, const std::array<double, 2>& position) const {
    const ItemId id = nth(ItemId::red_block, body);
    const Point centre = layout_.at(position);
    const double rim = rim_px(body);
    if (rim == 0) return {id, centre, radius_px(body), colors_[body].fill};
    return {id, centre, radius_px(body) - rim / 2, colors_[body].fill,
            Stroke{colors_[body].edge, rim}};
  }

  PixelRect frame_;
  Layout layout_;
  double data_line_px_;
  std::vector<BlockColors> colors_;
};

/// What is beside the stage of a row hides blocks that pass behind it: the counter. A line shows
/// where they vanish.
std::vector<DrawItem> cover_of(const DrawingContext& context) {
  const View& view = context.scene.view;
  const Layout& layout = context.layout;
  const std::optional<Color> background = background_of(view);
  if (!background || layout.visible_right_px >= view.width_px) return {};
  const double left = layout.content_right_px;
  const double top = layout.top_px() - kWallAbove * context.sizes.short_side;
  const Rect cover{left, 0, view.width_px - left, double(view.height_px)};
  const Rect line{left, top, context.sizes.grid_line, layout.wall_bottom_px - top};
  return {RectangleItem{nth(ItemId::blue_block, kCover), cover, background},
          RectangleItem{nth(ItemId::blue_block, kCover + 1), line, context.palette.grid}};
}

}  // namespace

ExposedBlock block_at(const Rect& bounds, const BlockColors& colors, const Layout& layout) {
  ExposedBlock block{bounds, colors.fill, Stroke{colors.edge, layout.line_px}, layout.corner_px};
  const double height = std::min(2 * layout.line_px, kBarSpacing * bounds.height / 2);
  for (int bar = 1; bar <= colors.bars; ++bar) {
    const bool is_upper = 2 * bar <= colors.bars;
    const double down = kBarSpacing * (is_upper ? bar : bar - colors.bars - 1);
    const double centre = std::round(bounds.y + bounds.height * (is_upper ? down : 1 + down));
    block.bars.push_back({centre - height / 2, height});
  }
  return block;
}

PlateItem plate_of(ItemId id, const Rect& bounds, std::vector<DrawItem> items) {
  return {id, bounds.whole_pixels(), std::make_shared<const Plate>(Plate{std::move(items)})};
}

void add_blocks(const FrameState& shown, const Layout& layout,
                const std::vector<BlockColors>& colors, std::vector<DrawItem>& items) {
  const std::size_t count = shown.state.bodies.size();
  std::vector<PlacedBody> blocks;
  blocks.reserve(count);
  for (std::size_t i = count; i-- > 0;) {
    blocks.push_back({block_id(i, count), i, block_at(layout.at(i, shown), colors[i], layout)});
  }
  const PixelRect seen{0, 0, int(std::ceil(layout.visible_right_px)),
                       int(std::ceil(layout.wall_bottom_px))};
  add_exposed(blocks, layout, seen, shown.exposure, items);
}

Drawable bodies(const DrawingContext& context) {
  if (context.is_plane()) {
    FrameNeeds needs{.trail_s = context.scene.show.has(Overlay::trails) ? kTrail_s : 0};
    for (std::size_t i = 0; i < context.scene.styles.size(); ++i) {
      if (context.scene.styles[i].path) needs.paths.push_back(i);
    }
    return {Discs(context), std::move(needs)};
  }
  return {[cover = cover_of(context), layout = context.layout, colors = context.colors](
              const FrameState& shown, std::vector<DrawItem>& items) {
    add_blocks(shown, layout, colors, items);
    items.insert(items.end(), cover.begin(), cover.end());
  }};
}

}  // namespace piblocks
