#include <piblocks/compose.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "draw/expose.hpp"
#include "draw/font.hpp"

namespace piblocks {
namespace {

constexpr Color kBackground = {255, 255, 255};
constexpr Color kWallEdge = {0, 0, 0};
constexpr Color kBlue = {38, 84, 204};
constexpr Color kBlueEdge = {22, 52, 134};
constexpr Color kRed = {214, 48, 40};
constexpr Color kRedEdge = {138, 24, 20};
constexpr Color kLabel = {96, 96, 96};
constexpr Color kCount = {16, 16, 16};

constexpr std::string_view kLabelText = "Collisions:";

// In parts of the frame's short measure, see short_measure().
constexpr double kTextSize = 0.074;
constexpr double kLineWidth = 0.0032;
constexpr double kMargin = 0.045;
constexpr double kUsualAspect = 16.0 / 9;
constexpr double kMaxBannerText = 2.2;
// A unit of the scene at least this large is rounded to an even number of pixels, so that edges
// that do not move are sharp, and so are the upper and lower edges of blocks of width 1.
constexpr double kMinRounded_px = 16;
// In ems of the label.
constexpr double kCapHeight = 0.73;
constexpr double kLabelGap = 1.0;  // between the label's baseline and the view
constexpr double kWordSpace = 0.34;
// In line widths.
constexpr double kDash = 4;

/// The length that type and lines are measured by: the frame's height, or less where the frame
/// is narrow.
double short_measure(const View& view) {
  return std::min<double>(view.height_px, 0.75 * view.width_px);
}

/// Size of type: a banner has little height and much width, and its text may have more of it.
double text_size(const View& view) {
  const double aspect = double(view.width_px) / view.height_px;
  return kTextSize * short_measure(view) * std::clamp(aspect / kUsualAspect, 1.0, kMaxBannerText);
}

double length(const Range& range) { return to_double(range.high - range.low); }

Rectangle to_pixels(const Layout& layout, double x, double y, double width, double height) {
  return {layout.origin.x + x * layout.scale, layout.origin.y - (y + height) * layout.scale,
          width * layout.scale, height * layout.scale};
}

RectangleItem compose_wall(const Scene& scene, const Layout& layout) {
  // The article's wall is a body of width 1 whose face is where blue turns back.
  const double face = to_double(scene.system.wall_face);
  const double bottom = to_double(scene.view.y.low);
  return {ItemId::wall, to_pixels(layout, face - 1, bottom, 1, length(scene.view.y)), std::nullopt,
          Stroke{kWallEdge, layout.line_px, kDash * layout.line_px}};
}

RectangleItem compose_block(ItemId id, const Block& block, const Motion& motion, Color fill,
                            Color edge, const Layout& layout) {
  const double side = to_double(block.width);
  return {id, to_pixels(layout, motion.position - side / 2, -side / 2, side, side), fill,
          Stroke{edge, layout.line_px, 0}};
}

RectangleItem compose_red(const Scene& scene, const Layout& layout, const BlockState& state) {
  return compose_block(ItemId::red_block, scene.system.red, state.red, kRed, kRedEdge, layout);
}

RectangleItem compose_blue(const Scene& scene, const Layout& layout, const BlockState& state) {
  return compose_block(ItemId::blue_block, scene.system.blue, state.blue, kBlue, kBlueEdge, layout);
}

DrawList compose_with(std::vector<DrawItem> blocks, const Scene& scene, const Layout& layout,
                      const BlockState& state) {
  DrawList list{layout.width_px, layout.height_px, kBackground, {compose_wall(scene, layout)}};
  std::ranges::move(blocks, std::back_inserter(list.items));
  list.items.emplace_back(
      TextItem{ItemId::label, layout.label, std::string(kLabelText), layout.text_px, kLabel});
  list.items.emplace_back(TextItem{ItemId::count,
                                   {layout.count_x, layout.label.y},
                                   with_thousands_separators(state.count),
                                   layout.text_px,
                                   kCount});
  return list;
}

}  // namespace

Layout lay_out(const Scene& scene, const Integer& longest_count) {
  const View& view = scene.view;
  const double measure = short_measure(view);
  const double margin = kMargin * measure;
  const double inner_width = view.width_px - 2 * margin;

  const Font font;
  const double label_em = font.width_em(kLabelText) + kWordSpace;
  const double line_em = label_em + font.width_em(with_thousands_separators(longest_count));

  Layout layout;
  layout.width_px = view.width_px;
  layout.height_px = view.height_px;
  layout.line_px = std::max(1.0, std::round(kLineWidth * measure));
  layout.text_px = std::min(text_size(view), inner_width / line_em);

  // Label and view form one group, centred in the frame.
  const double label_height = (kCapHeight + kLabelGap) * layout.text_px;
  const double inner_height = view.height_px - 2 * margin - label_height;
  layout.scale = std::min(inner_width / length(view.x), inner_height / length(view.y));
  const bool rounded = layout.scale >= kMinRounded_px;
  const auto to_pixel = [&](double px) { return rounded ? std::round(px) : px; };
  if (rounded) layout.scale = 2 * std::floor(layout.scale / 2);
  const double view_width = layout.scale * length(view.x);
  const double view_height = layout.scale * length(view.y);
  const double top = (view.height_px - view_height - label_height) / 2;
  layout.origin = {
      to_pixel((view.width_px - view_width) / 2 - to_double(view.x.low) * layout.scale),
      to_pixel(top + label_height + to_double(view.y.high) * layout.scale)};
  layout.label = {(view.width_px - line_em * layout.text_px) / 2,
                  to_pixel(top + kCapHeight * layout.text_px)};
  layout.count_x = layout.label.x + label_em * layout.text_px;
  return layout;
}

DrawList compose(const Scene& scene, const Layout& layout, const BlockState& state) {
  return compose_with({compose_red(scene, layout, state), compose_blue(scene, layout, state)},
                      scene, layout, state);
}

DrawList compose(const Scene& scene, const Layout& layout, const BlockState& state,
                 std::span<const ExposurePart> parts) {
  return compose_with({expose(compose_red(scene, layout, state), compose_blue(scene, layout, state),
                              scene.system, layout, parts)},
                      scene, layout, state);
}

}  // namespace piblocks
