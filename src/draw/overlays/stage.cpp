#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

constexpr std::string_view kLabelText = "Collisions:";

constexpr double kUsualAspect = 16.0 / 9;
constexpr double kMostBannerText = 2.2;
/// From this size on, a unit of the scene is rounded to an even number of pixels. That makes edges
/// that do not move sharp, and the upper and lower edges of blocks of width 1.
constexpr double kMinRounded_px = 16;
/// Greatest distance of neighbouring doubles on the axis.
constexpr double kMostStep_px = 0.25;
// In ems of the label.
constexpr double kLabelGap = 1.0;  // between the label's baseline and the view
constexpr double kWordSpace = 0.34;
/// Sums of the same advances in different order differ by less.
constexpr double kNegligible_em = 1e-6;
// In parts of a block's height: from the edge to the first bar, and from bar to bar.
constexpr double kBarStep = 0.1;
// In line widths.
constexpr double kDash = 4;

/// Size of type. A banner is low and wide, and its text may take more of its height.
double text_size(const Rectangle& area) {
  const double aspect = area.width / area.height;
  return style::kCounter * short_measure(area) *
         std::clamp(aspect / kUsualAspect, 1.0, kMostBannerText);
}

double length(const Range& range) { return to_double(range.high - range.low); }

/// Length of the expected beginning of the count, with separators; 0 while it has fewer digits.
std::size_t lit_length(std::string_view count, std::string_view expected) {
  if (count.size() != expected.size()) return 0;
  const auto* const end = std::ranges::mismatch(count, expected).in1;
  auto length = static_cast<std::size_t>(end - count.begin());
  if (length > 0 && length < count.size() && count[length - 1] == ',') --length;
  return length;
}

/// Positions are doubles: far from 0 and close up, blocks would be drawn in wrong places.
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

class Stage {
 public:
  Stage(const DrawingContext& context, std::string lit_digits)
      : layout_(context.layout),
        palette_(context.palette),
        wall_(wall_of(context.scene)),
        base_(base_of(context.scene.system)),
        blue_side_(to_double(context.scene.system.blue.width)),
        red_side_(to_double(context.scene.system.red.width)),
        lit_digits_(std::move(lit_digits)),
        base_of_counts_(context.scene.show.base),
        widths_(context.font, count_characters(base_of_counts_)) {}

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(wall_);
    ExposedBlock red = block(red_side_, shown.state.red, palette_.red);
    ExposedBlock blue = block(blue_side_, shown.state.blue, palette_.blue);
    if (shown.exposure.empty()) {
      add_rectangles(ItemId::red_block, red, items);
      add_rectangles(ItemId::blue_block, blue, items);
    } else {
      items.emplace_back(exposed_item(std::move(red), std::move(blue), layout_, shown.exposure));
    }
    add_line(shown.state.count, items);
  }

 private:
  /// The article's wall is a body of width 1 whose face is where blue turns back.
  RectangleItem wall_of(const Scene& scene) const {
    const double face = to_double(scene.system.wall_face);
    const double bottom = to_double(scene.view.y.low);
    return {ItemId::wall, layout_.at(face - 1, bottom, 1, length(scene.view.y)), std::nullopt,
            Stroke{palette_.wall, layout_.line_px, kDash * layout_.line_px}};
  }

  ExposedBlock block(double side, const Motion& motion, const BlockColors& colors) const {
    ExposedBlock block{layout_.at(motion.position - side / 2, base_, side, side),
                       colors.fill,
                       Stroke{colors.edge, layout_.line_px},
                       {},
                       {}};
    const Rectangle& bounds = block.bounds;
    const double height = std::min(2 * layout_.line_px, kBarStep * bounds.height / 2);
    for (int bar = 1; bar <= colors.bars; ++bar) {
      const bool is_upper = 2 * bar <= colors.bars;
      const double down = kBarStep * (is_upper ? bar : bar - colors.bars - 1);
      const double centre = std::round(bounds.y + bounds.height * (is_upper ? down : 1 + down));
      block.bars.push_back({centre - height / 2, height});
    }
    return block;
  }

  /// Label and count, smaller if an instant outside of the film has a longer count than any in it.
  void add_line(const Integer& count, std::vector<DrawItem>& items) const {
    const std::string text = count_text(count, base_of_counts_);
    const std::size_t lit = lit_length(text, lit_digits_);
    Point label = layout_.label;
    double text_px = layout_.text_px;
    const double count_em = widths_.width_em(text);
    if (count_em > layout_.count_em + kNegligible_em) {
      const double line_em = layout_.label_em + count_em;
      text_px = std::min(text_px, layout_.line_room_px / line_em);
      label.x = layout_.line_left_px + (layout_.line_room_px - line_em * text_px) / 2;
    }
    const Point origin{label.x + layout_.label_em * text_px, label.y};
    items.emplace_back(
        TextItem{ItemId::label, label, std::string(kLabelText), text_px, palette_.muted});
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
  RectangleItem wall_;
  double base_;
  double blue_side_;
  double red_side_;
  std::string lit_digits_;
  int base_of_counts_;
  TextWidths widths_;
};

}  // namespace

double base_of(const BlockSystem& system) {
  return -to_double(std::max(system.blue.width, system.red.width)) / 2;
}

Rational twice_energy(const BlockSystem& system) {
  return system.blue.mass * system.blue.velocity * system.blue.velocity +
         system.red.mass * system.red.velocity * system.red.velocity;
}

Layout lay_out(const Scene& scene, const Integer& longest_count, const Rectangle& area,
               const Font& font) {
  const View& view = scene.view;
  const double margin = style::kMargin * short_measure(area);
  const double inner_width = area.width - 2 * margin;

  const double label_em = font.width_em(kLabelText) + kWordSpace;
  const double line_em = label_em + count_width_em(longest_count, scene.show.base, font);

  Layout layout;
  layout.frame_px = view.width_px;
  layout.line_px = std::max(1.0, std::round(line_width_px(view)));
  layout.text_px = std::min(text_size(area), inner_width / line_em);

  // Label and view form one group, centred in the area.
  const double label_height = (Font::kCapHeight_em + kLabelGap) * layout.text_px;
  const double inner_height = area.height - 2 * margin - label_height;
  layout.scale = std::min(inner_width / length(view.x), inner_height / length(view.y));
  const bool rounded = layout.scale >= kMinRounded_px;
  const auto to_pixel = [&](double px) { return rounded ? std::round(px) : px; };
  if (rounded) layout.scale = 2 * std::floor(layout.scale / 2);
  check_resolution(view, layout.scale);
  const double view_width = layout.scale * length(view.x);
  const double view_height = layout.scale * length(view.y);
  const double top = area.y + (area.height - view_height - label_height) / 2;
  layout.origin = {
      to_pixel(area.x + (area.width - view_width) / 2 - to_double(view.x.low) * layout.scale),
      to_pixel(top + label_height + to_double(view.y.high) * layout.scale)};
  layout.label = {area.x + (area.width - line_em * layout.text_px) / 2,
                  to_pixel(top + Font::kCapHeight_em * layout.text_px)};
  layout.label_em = label_em;
  layout.count_em = line_em - label_em;
  layout.line_left_px = area.x + margin;
  layout.line_room_px = inner_width;
  layout.above_px = kLabelGap * layout.text_px / 2;
  layout.below_px = area.y + area.height - (top + label_height + view_height);
  return layout;
}

Drawable stage(const DrawingContext& context, std::string lit_digits) {
  return Stage(context, std::move(lit_digits));
}

}  // namespace piblocks
