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

// Heights above the taller block, or the mass above it, in fractions of the frame's shorter side.
constexpr double kShaft = 0.022;
constexpr double kVelocityBaseline = 0.052;
constexpr double kAboveFigures = 0.003;
constexpr double kHead = 0.014;
/// Arrows are shorter than this part of the distance between the centres of touching blocks.
/// Centred above its block, an arrow never meets the other one.
constexpr double kLongest = 0.9;
constexpr double kBetweenFigures_em = 0.5;
constexpr const char* kUsualFigure = "−88.88";
/// An arrow of so many times the usual speed has half the greatest length.
constexpr double kHalfLength = 2;

/// The heavier block's speed when it has all the energy. It may be below the range of a double.
mpf_class usual_speed(const BlockSystem& system) {
  return root_of(twice_energy(system) / std::max(system.blue.mass, system.red.mass));
}

double arrow_room_px(const Sizes& sizes) {
  return std::max(
      kArrowRoom * sizes.short_side,
      (kVelocityBaseline + kAboveFigures) * sizes.short_side + Font::kCapHeight_em * sizes.text);
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
        font_face_(context.font.face()),
        widths_(context.font, kNumberCharacters),
        usual_speed_(usual_speed(context.scene.system)),
        line_px_(context.sizes.data_line),
        short_side_(context.sizes.short_side),
        text_px_(context.sizes.text) {
    const Scene& scene = context.scene;
    const bool is_over_mass =
        scene.show.has(Overlay::masses) && has_mass_above(scene, layout_, context.font);
    const double masses = is_over_mass ? mass_room_px(context.sizes) : 0;
    foot_px_ = layout_.top_px() - masses;
    const double room = arrow_room_px(context.sizes);
    if (layout_.above_px + kRounded_px < room + masses) {
      throw UsageError(
          fmt::format("show.overlays: the velocities need {:.0f} pixels above the blocks, and "
                      "there are {:.0f}; leave out 'velocities', or make the frame higher",
                      room, std::max(0.0, layout_.above_px - masses)));
    }
    longest_px_ = kLongest * (layout_.blue.width + layout_.red.width) / 2 * layout_.scale;
    const double face_px = layout_.at(to_double(scene.system.wall_face), 0).x;
    const double margin_px = kBetweenFigures_em / 2 * text_px_;
    const double margin = context.sizes.margin;
    least_left_px_ = std::max(margin, face_px + margin_px);
    most_right_px_ = std::min(scene.view.width_px - margin, layout_.content_right_px);
    const double figures = (2 * widths_.width_em(kUsualFigure) + kBetweenFigures_em) * text_px_;
    if (most_right_px_ - least_left_px_ < figures) {
      throw UsageError(
          fmt::format("show.overlays: the velocities need {:.0f} pixels beside the wall, and there "
                      "are {:.0f}; leave out 'velocities', or make the frame wider",
                      figures, std::max(0.0, most_right_px_ - least_left_px_)));
    }
    blue_px_ = layout_.blue.width * layout_.scale;
    red_px_ = layout_.red.width * layout_.scale;
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    const auto [count, blue_motion, red_motion] = blocks_state(shown.state);
    std::optional<Figure> red = figure_of(2, red_motion, red_px_);
    std::optional<Figure> blue = figure_of(6, blue_motion, blue_px_);
    if (red && blue) {
      keep_apart(*blue, *red);
    } else if (red || blue) {
      double& left = red ? red->left() : blue->left();
      left = std::max(left, least_left_px_);
    }
    if (red) {
      add_arrow(0, red_motion, palette_.red.line, items);
      items.emplace_back(std::move(red->item));
    }
    if (blue) {
      add_arrow(4, blue_motion, palette_.blue.line, items);
      items.emplace_back(std::move(blue->item));
    }
  }

 private:
  /// A block that has left the frame has no figure: half a figure would be another number.
  std::optional<Figure> figure_of(std::size_t n, const Motion& motion, double side_px) const {
    const Point foot{layout_.at(motion.position, 0).x, foot_px_};
    if (foot.x + side_px / 2 <= 0 || foot.x - side_px / 2 >= layout_.visible_right_px) {
      return std::nullopt;
    }
    std::string text = rounded_text(motion.velocity);
    const double width = widths_.width_em(text) * text_px_;
    const double left = std::min(foot.x - width / 2, most_right_px_ - width);
    return Figure{{nth(ItemId::velocities, n),
                   {left, foot.y - kVelocityBaseline * short_side_},
                   std::move(text),
                   text_px_,
                   palette_.text,
                   font_face_},
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
    const Point foot{layout_.at(motion.position, 0).x, foot_px_};
    const double y = foot.y - kShaft * short_side_;
    const double head = kHead * short_side_;
    const double length = length_px(motion.velocity);
    if (std::abs(length) <= head) return;
    const double tail = foot.x - length / 2;
    const double tip = foot.x + length / 2;
    const double neck = tip - std::copysign(head, length);
    items.emplace_back(PathItem{nth(ItemId::velocities, n),
                                std::vector<Point>{{tail, y}, {neck, y}}, false, std::nullopt,
                                Stroke{color, 1.5 * line_px_}});
    items.emplace_back(PathItem{nth(ItemId::velocities, n + 1),
                                std::vector<Point>{{tip, y}, {neck, y - head}, {neck, y + head}},
                                true, color, std::nullopt});
  }

  Layout layout_;
  Palette palette_;
  Face font_face_;
  TextWidths widths_;
  mpf_class usual_speed_;
  double line_px_;
  double short_side_;
  double text_px_;
  double foot_px_ = 0;  ///< arrows and figures are above it
  double longest_px_ = 0;
  double least_left_px_ = 0;
  double most_right_px_ = 0;
  double blue_px_ = 0;
  double red_px_ = 0;
};

}  // namespace

double room_above_px(const Scene& scene, const Layout& layout, const Font& font) {
  const Sizes sizes(scene.view);
  const bool has_mass = scene.show.has(Overlay::masses) && has_mass_above(scene, layout, font);
  return (has_mass ? mass_room_px(sizes) : 0) +
         (scene.show.has(Overlay::velocities) ? arrow_room_px(sizes) : 0);
}

Drawable velocity_arrows(const DrawingContext& context) { return VelocityArrows(context); }

}  // namespace piblocks
