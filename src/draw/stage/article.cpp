#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

constexpr std::string_view kLabelText = "Collisions:";

constexpr double kUsualAspect = 16.0 / 9;
constexpr double kMostBannerText = 2.2;
// In ems of the label.
constexpr double kLabelGap = 1.0;  // between the label's baseline and the view
/// Overlays take at most this part of the area's height in addition.
constexpr double kMostOfArea = 0.3;
/// Sums of the same advances in different order differ by less.
constexpr double kNegligible_em = 1e-6;
constexpr double kDash = 4;         // in line widths
constexpr double kMostWall = 0.25;  // width of the line, in the scene

/// Size of type. A banner is low and wide, and its text may take more of its height.
double text_size(const Rect& area) {
  const double aspect = area.width / area.height;
  return article_style::kCounter * article_style::short_measure(area) *
         std::clamp(aspect / kUsualAspect, 1.0, kMostBannerText);
}

double length_of(const Range& range) { return to_double(range.high - range.low); }

class ArticleBlocks {
 public:
  ArticleBlocks(const DrawingContext& context, std::string lit_digits)
      : layout_(context.layout),
        palette_(context.palette),
        colors_(context.colors),
        lit_digits_(std::move(lit_digits)),
        base_(context.scene.show.base),
        widths_(context.font, count_characters(base_) + std::string(kEndlessCount)) {}

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    add_blocks(shown, layout_, colors_, items);
    add_line(shown.state, items);
  }

 private:
  /// Label and count, smaller if an instant outside of the film has a longer count than any in it.
  void add_line(const State& state, std::vector<DrawItem>& items) const {
    const std::string text =
        state.is_infinite ? std::string(kEndlessCount) : count_text(state.count, base_);
    const std::size_t lit = lit_length(text, lit_digits_);
    const CountLine& line = layout_.count_line;
    Point label = line.label;
    double text_px = line.text_px;
    const double count_em = widths_.width_em(text);
    if (count_em > line.count_em + kNegligible_em) {
      const double line_em = line.label_em + count_em;
      text_px = std::min(text_px, line.room_px / line_em);
      label.x = line.left_px + (line.room_px - line_em * text_px) / 2;
    }
    const Point origin{label.x + line.label_em * text_px, label.y};
    items.emplace_back(
        TextItem{ItemId::label, label, std::string(kLabelText), text_px, palette_.text});
    if (lit > 0) {
      items.emplace_back(
          TextItem{ItemId::lit_count, origin, text.substr(0, lit), text_px, palette_.accent});
    }
    if (lit < text.size()) {
      const double lit_px = lit > 0 ? widths_.width_em(text.substr(0, lit)) * text_px : 0;
      items.emplace_back(TextItem{
          ItemId::count, {origin.x + lit_px, origin.y}, text.substr(lit), text_px, palette_.text});
    }
  }

  Layout layout_;
  Palette palette_;
  std::vector<BlockColors> colors_;
  std::string lit_digits_;
  int base_;  ///< of counts
  TextWidths widths_;
};

/// What overlays need in addition, in pixels.
struct ExtraRoom {
  double above = 0;  ///< between label and view
  double below = 0;  ///< the view
};

/// Label and view form one group, centred in the area.
Layout article_layout(const LayoutContext& context, const CountLine& count_line, const Rect& area,
                      const ExtraRoom& extra) {
  const View& view = context.scene.view;
  const double margin = article_style::kMargin * article_style::short_measure(area);
  Layout layout;
  layout.count_line = count_line;
  CountLine& line = layout.count_line;
  layout.visible_right_px = view.width_px;
  layout.content_right_px = view.width_px - Sizes(view).margin;
  layout.line_px =
      std::max(1.0, std::round(article_style::kLine * article_style::short_measure(whole(view))));
  const double gap = kLabelGap * line.text_px + extra.above;
  const double label_height = Font::kCapHeight_em * line.text_px + gap;
  const double inner_height = area.height - 2 * margin - label_height - extra.below;
  layout.scale =
      std::min((area.width - 2 * margin) / length_of(view.x), inner_height / length_of(view.y));
  const bool rounded = layout.scale >= kLeastRounded_px;
  const auto to_pixel = [&](double px) { return rounded ? std::round(px) : px; };
  if (rounded) layout.scale = 2 * std::floor(layout.scale / 2);
  check_resolution(view.x, "view.x", layout.scale);
  const double view_width = layout.scale * length_of(view.x);
  const double view_height = layout.scale * length_of(view.y);
  const double top = area.y + (area.height - view_height - label_height - extra.below) / 2;
  layout.origin = {
      to_pixel(area.x + (area.width - view_width) / 2 - to_double(view.x.low) * layout.scale),
      to_pixel(top + label_height + to_double(view.y.high) * layout.scale)};
  line.label.y = to_pixel(top + Font::kCapHeight_em * line.text_px);

  // The largest block's middle is at 0, and its sides are equal.
  double largest = 0;
  for (const Body& body : context.scene.system.bodies) {
    const double side = to_double(body.size);
    layout.shapes.push_back({side, side * layout.scale});
    largest = std::max(largest, side);
  }
  const double half = largest / 2;
  layout.floor_px = layout.at(0, -half).y;
  layout.wall_bottom_px = layout.at(0, to_double(view.y.low)).y;
  layout.above_px = (to_double(view.y.high) - half) * layout.scale + gap - line.text_px / 2;
  layout.below_px = area.bottom() - layout.floor_px;
  return layout;
}

}  // namespace

Layout lay_out_article(const LayoutContext& context, const Integer& longest_count,
                       const Rect& area) {
  const Font& font = context.font;
  const double margin = article_style::kMargin * article_style::short_measure(area);
  CountLine line;
  line.label_em = font.width_em(kLabelText);
  const double line_em =
      line.label_em + count_width_em(longest_count, context.scene.show.base, font);
  line.count_em = line_em - line.label_em;
  line.left_px = area.x + margin;
  line.room_px = area.width - 2 * margin;
  line.text_px = std::min(text_size(area), line.room_px / line_em);
  line.label.x = area.x + (area.width - line_em * line.text_px) / 2;

  // The label makes room for what is above the blocks. That may make the blocks smaller, and then a
  // mass may no longer fit on its block.
  constexpr int kPasses = 4;
  ExtraRoom extra;
  Layout layout = article_layout(context, line, area, extra);
  for (int pass = 0; pass < kPasses; ++pass) {
    const double above = room_above_px(context, layout) - layout.above_px;
    const double below = room_below_px(context, layout) - layout.below_px;
    extra.above += std::max(0.0, above);
    extra.below += std::max(0.0, below);
    if (std::max(above, below) <= 0 || extra.above + extra.below > kMostOfArea * area.height) break;
    layout = article_layout(context, line, area, extra);
  }
  return layout;
}

PathItem article_wall(const Layout& layout, const View& view, const Color& color, double face,
                      int side) {
  const double line_px = std::min(layout.line_px, kMostWall * layout.scale);
  const Point top = layout.at(face, to_double(view.y.high));
  // Beside the face, so that the line is whole where a block touches it.
  const double x = top.x - side * line_px / 2;
  const double bottom = layout.at(0, to_double(view.y.low)).y;
  return line_item(ItemId::wall, {{x, top.y}, {x, bottom}}, {color, line_px, kDash * line_px});
}

std::vector<DrawItem> article_walls(const DrawingContext& context) {
  const LineWalls walls = line_walls(context.scene.system);
  std::vector<DrawItem> items;
  const auto add = [&](const Rational& face, int side) {
    PathItem wall = article_wall(context.layout, context.scene.view, context.palette.wall,
                                 to_double(face), side);
    wall.id = nth(ItemId::wall, items.size());
    items.emplace_back(std::move(wall));
  };
  if (walls.left) add(*walls.left, 1);
  if (walls.right) add(*walls.right, -1);
  return items;
}

Drawable article_blocks(const DrawingContext& context, std::string lit_digits) {
  return {ArticleBlocks(context, std::move(lit_digits))};
}

}  // namespace piblocks
