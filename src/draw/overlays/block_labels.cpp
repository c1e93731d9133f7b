#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

// Size of a mass, in parts of the block's side.
constexpr double kHeight = 0.3;
constexpr double kWidth = 0.84;
constexpr double kLeast_px = 4;

/// The label of a block whose middle is in column 0.
TextItem mass_label(ItemId id, const Block& block, const BlockColors& colors,
                    const DrawingContext& context) {
  const double side_px = to_double(block.width) * context.layout.scale;
  std::string text = short_text(block.mass);
  const double width_em = context.font.width_em(text);
  const double size_px = context.font.fitted_px(text, kHeight * side_px, kWidth * side_px);
  if (size_px < kLeast_px) {
    throw UsageError(fmt::format(
        "show.overlays: the mass '{}' would be {:.1f} pixels high on its block, which cannot be "
        "read; leave out 'masses', or make the frame or the block larger",
        text, size_px));
  }
  const double middle = base_of(context.scene.system) + to_double(block.width) / 2;
  const double baseline = context.layout.at(0, middle).y + kHalfFigure_em * size_px;
  return {id, {-width_em * size_px / 2, baseline}, std::move(text), size_px, colors.text};
}

// In parts of the room above the blocks.
constexpr double kShaft = 0.3;              // height of the shaft above the block
constexpr double kVelocityBaseline = 0.54;  // height of the figure's baseline, clear of the head
constexpr double kVelocitySize = 0.4;
constexpr double kHead = 0.17;
constexpr double kLeastArrowRoom_px = 16;
/// Arrows are shorter than this part of the distance between the centres of touching blocks.
/// Centred above its block, an arrow never meets the other one.
constexpr double kLongest = 0.9;
constexpr double kBetweenFigures_em = 0.5;
/// An arrow of so many times the usual speed has half the greatest length.
constexpr double kHalfLength = 2;

/// The heavier block's speed when it has all the energy. It may be below the range of a double.
mpf_class usual_speed(const BlockSystem& system) {
  return root_of(twice_energy(system) / std::max(system.blue.mass, system.red.mass));
}

struct Figure {
  TextItem item;
  double width;

  double& left() { return item.origin.x; }
};

class VelocityArrows {
 public:
  explicit VelocityArrows(const DrawingContext& context)
      : layout_(context.layout),
        palette_(context.palette),
        widths_(context.font, kNumberCharacters),
        usual_speed_(usual_speed(context.scene.system)),
        line_px_(context.line_px),
        top_(-base_of(context.scene.system)),
        room_px_((to_double(context.scene.view.y.high) - top_) * layout_.scale + layout_.above_px),
        text_px_(std::min(kVelocitySize * room_px_, context.text_px)) {
    if (room_px_ < kLeastArrowRoom_px) {
      throw UsageError(fmt::format(
          "show.overlays: the velocities need {} pixels above the blocks, and there are {:.0f}; "
          "raise the upper end of view.y, or make the frame larger",
          kLeastArrowRoom_px, std::max(0.0, room_px_)));
    }
    const BlockSystem& system = context.scene.system;
    longest_px_ = kLongest * to_double(system.blue.width + system.red.width) / 2 * layout_.scale;
    const double face_px = layout_.at(to_double(system.wall_face), 0).x;
    const double margin_px = kBetweenFigures_em / 2 * text_px_;
    least_left_px_ = std::max(0.0, face_px) + margin_px;
    most_right_px_ = layout_.frame_px - margin_px;
    blue_px_ = to_double(system.blue.width) * layout_.scale;
    red_px_ = to_double(system.red.width) * layout_.scale;
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    std::optional<Figure> red = figure_of(2, shown.state.red, red_px_);
    std::optional<Figure> blue = figure_of(6, shown.state.blue, blue_px_);
    if (red && blue) {
      keep_apart(*blue, *red);
    } else if (red || blue) {
      double& left = red ? red->left() : blue->left();
      left = std::max(left, least_left_px_);
    }
    if (red) {
      add_arrow(0, shown.state.red, palette_.red.fill, items);
      items.emplace_back(std::move(red->item));
    }
    if (blue) {
      add_arrow(4, shown.state.blue, palette_.blue.fill, items);
      items.emplace_back(std::move(blue->item));
    }
  }

 private:
  /// A block that has left the frame has no figure: half a figure would be another number.
  std::optional<Figure> figure_of(std::size_t n, const Motion& motion, double side_px) const {
    const Point foot = layout_.at(motion.position, top_);
    if (foot.x + side_px / 2 <= 0 || foot.x - side_px / 2 >= layout_.frame_px) return std::nullopt;
    std::string text = rounded_text(motion.velocity);
    const double width = widths_.width_em(text) * text_px_;
    const double left = std::min(foot.x - width / 2, most_right_px_ - width);
    return Figure{{nth(ItemId::velocities, n),
                   {left, foot.y - kVelocityBaseline * room_px_},
                   std::move(text),
                   text_px_,
                   palette_.text},
                  width};
  }

  double length_px(double velocity) const {
    const double speed = std::abs(velocity);
    if (!(usual_speed_ > 0) || !(speed > 0)) return 0;
    const double share = 1 / (1 + kHalfLength * mpf_class(usual_speed_ / speed).get_d());
    return std::copysign(share * longest_px_, velocity);
  }

  /// Each figure gives way by half of the overlap. Blue's, which is on the left, does not go into
  /// the wall, nor red's out of the frame, as long as there is room for both between.
  void keep_apart(Figure& blue, Figure& red) const {
    blue.left() = std::max(blue.left(), least_left_px_);
    const double overlap = blue.left() + blue.width + kBetweenFigures_em * text_px_ - red.left();
    if (overlap <= 0) return;
    const double room_right = std::max(0.0, most_right_px_ - red.width - red.left());
    const double wanted = std::max(overlap / 2, overlap - room_right);
    const double to_left = std::clamp(wanted, 0.0, blue.left() - least_left_px_);
    blue.left() -= to_left;
    red.left() += overlap - to_left;
  }

  void add_arrow(std::size_t n, const Motion& motion, const Color& color,
                 std::vector<DrawItem>& items) const {
    const Point foot = layout_.at(motion.position, top_);
    const double y = foot.y - kShaft * room_px_;
    const double head = kHead * room_px_;
    const double length = length_px(motion.velocity);
    if (std::abs(length) <= head) return;
    const double tail = foot.x - length / 2;
    const double tip = foot.x + length / 2;
    const double neck = tip - std::copysign(head, length);
    const Color edge = palette_.text;
    items.emplace_back(PathItem{nth(ItemId::velocities, n),
                                std::vector<Point>{{tail, y}, {neck, y}}, false, std::nullopt,
                                Stroke{edge, 2 * line_px_}});
    items.emplace_back(PathItem{nth(ItemId::velocities, n + 1),
                                std::vector<Point>{{tip, y}, {neck, y - head}, {neck, y + head}},
                                true, color, Stroke{edge, line_px_}});
  }

  Layout layout_;
  Palette palette_;
  TextWidths widths_;
  mpf_class usual_speed_;
  double line_px_;
  double top_;  ///< of the larger block, in units of the scene
  double room_px_;
  double text_px_;
  double longest_px_ = 0;
  double least_left_px_ = 0;
  double most_right_px_ = 0;
  double blue_px_ = 0;
  double red_px_ = 0;
};

}  // namespace

Drawable mass_labels(const DrawingContext& context) {
  const BlockSystem& system = context.scene.system;
  const TextItem red = mass_label(nth(ItemId::masses, 0), system.red, context.palette.red, context);
  const TextItem blue =
      mass_label(nth(ItemId::masses, 1), system.blue, context.palette.blue, context);
  return [=, layout = context.layout](const FrameState& shown, std::vector<DrawItem>& items) {
    const auto add = [&](TextItem label, const Motion& motion) {
      label.origin.x += layout.at(motion.position, 0).x;
      items.emplace_back(std::move(label));
    };
    add(red, shown.state.red);
    add(blue, shown.state.blue);
  };
}

Drawable velocity_arrows(const DrawingContext& context) { return VelocityArrows(context); }

}  // namespace piblocks
