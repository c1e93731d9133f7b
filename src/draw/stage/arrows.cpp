#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

// Heights above the tallest block, or the label above it, in fractions of the frame's shorter side.
constexpr double kShaft = 0.022;
constexpr double kVelocityBaseline = 0.052;
constexpr double kAboveFigures = 0.003;
constexpr double kHead = 0.014;
/// Arrows are shorter than this part of the distance between the centres of touching blocks.
/// Centred above its block, an arrow never meets another one.
constexpr double kLongest = 0.9;
constexpr double kBetweenFigures_em = 0.5;
constexpr const char* kUsualFigure = "−88.88";
/// An arrow of so many times the usual speed has half the greatest length.
constexpr double kHalfLength = 2;
/// More blocks have no figures if there is no room for all.
constexpr std::size_t kAlwaysFigures = 2;
/// Length of a disc's arrow at the usual speed, in fractions of the frame's shorter side.
constexpr double kDiscArrow = 0.08;
/// Of a body: a shaft, a head and a figure.
constexpr std::size_t kIds = 4;

double arrow_room_px(const Sizes& sizes) {
  return std::max(
      kArrowRoom * sizes.short_side,
      (kVelocityBaseline + kAboveFigures) * sizes.short_side + Font::kCapHeight_em * sizes.text);
}

/// Of the arrow above a block: the first of its shaft, its head and its figure.
ItemId arrow_id(std::size_t body, std::size_t count) {
  return nth(ItemId::velocities, kIds * (count - 1 - body));
}

/// A shaft and a head, of different lines where there are blocks and where there are discs.
struct Arrow {
  ItemId id = ItemId::velocities;
  Point tail;
  Point tip;
  Color color;
  double line_px = 1;
  double head_px = 1;       ///< length of the head
  double half_head_px = 1;  ///< and half its width
};

/// Nothing where the arrow would be no longer than its head.
void add_arrow(const Arrow& arrow, std::vector<DrawItem>& items) {
  const auto& [id, tail, tip, color, line_px, head, half_head] = arrow;
  const double length_px = length(tip - tail);
  if (length_px <= head) return;
  const Point along = (tip - tail) / length_px;
  const Point neck = tip - head * along;
  const Point aside = (along.x < 0 ? half_head : -half_head) * turned_right(along);
  items.emplace_back(line_item(id, {tail, neck}, {color, line_px}));
  items.emplace_back(
      PathItem{nth(id, 1), std::vector<Point>{tip, neck + aside, neck - aside}, true, color});
}

struct Figure {
  std::size_t body;
  TextItem item;
  double width;

  double& left() { return item.origin.x; }
};

/// Moves figures, in the order from left to right, as little as keeps them apart and in the room:
/// two that overlap give way by half of that. (Means of blocks that pool, as in isotonic
/// regression.)
void keep_apart(std::vector<Figure>& figures, const Columns& room, double gap) {
  struct Group {
    double sum;  ///< of where its figures would be if those left of them had no width
    double count;
    double mean() const { return sum / count; }
  };
  std::vector<Group> groups;
  double before = 0;
  for (Figure& figure : figures) {
    figure.left() = std::max(figure.left(), room.left);
    groups.push_back({figure.left() - before, 1});
    while (groups.size() > 1 && groups[groups.size() - 2].mean() > groups.back().mean()) {
      groups[groups.size() - 2].sum += groups.back().sum;
      groups[groups.size() - 2].count += groups.back().count;
      groups.pop_back();
    }
    before += figure.width + gap;
  }
  const double last = std::max(room.left, room.right - (before - gap));
  before = 0;
  auto next = figures.begin();
  for (const Group& group : groups) {
    const double place = std::clamp(group.mean(), room.left, last);
    for (double n = 0; n < group.count; ++n, ++next) {
      const bool moves = group.count > 1 || place != group.mean();
      if (moves) next->left() = place + before;
      before += next->width + gap;
    }
  }
}

class BlockArrows {
 public:
  explicit BlockArrows(const DrawingContext& context)
      : layout_(context.layout),
        colors_(context.colors),
        text_color_(context.palette.text),
        font_face_(context.font.face()),
        widths_(context.font, kNumberCharacters),
        lengths_(context.scene, context.log, context.layout),
        sizes_(context.sizes) {
    const System& system = context.scene.system;
    for (std::size_t i = system.bodies.size(); i-- > 0;) {
      if (system.bodies[i].mass) moving_.push_back(i);
    }
    place_foot(context);
    place_figures(context);
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    std::vector<Figure> figures;
    if (has_figures_) figures = figures_of(shown);
    const std::size_t count = layout_.shapes.size();
    for (const std::size_t body : moving_) {
      const auto figure = std::ranges::find(figures, body, &Figure::body);
      if (has_figures_ && figure == figures.end()) continue;
      const double middle = layout_.at(shown.state.bodies[body].position[0], 0).x;
      const double half = lengths_.length_px(shown.state.bodies[body].velocity[0]) / 2;
      const double y = foot_px_ - kShaft * sizes_.short_side;
      const double head = kHead * sizes_.short_side;
      add_arrow({arrow_id(body, count),
                 {middle - half, y},
                 {middle + half, y},
                 colors_[body].line,
                 1.5 * sizes_.data_line,
                 head,
                 head},
                items);
      if (figure != figures.end()) items.emplace_back(std::move(figure->item));
    }
  }

 private:
  void place_foot(const DrawingContext& context) {
    const bool is_over_label = !labelled_above(context, layout_).empty();
    const double labels = is_over_label ? label_room_px(context.sizes) : 0;
    foot_px_ = layout_.top_px() - labels;
    const double room = arrow_room_px(context.sizes);
    if (layout_.above_px + kRounded_px >= room + labels) return;
    throw UsageError("show.overlays",
                     fmt::format("the velocities need {:.0f} pixels above the blocks, and there "
                                 "are {:.0f}; leave out 'velocities', or make the frame higher",
                                 room, std::max(0.0, layout_.above_px - labels)),
                     exact_text(Overlay::velocities));
  }

  void place_figures(const DrawingContext& context) {
    room_ = text_columns_between_walls(context);
    const auto width = [&](std::size_t count) {
      return (double(count) * widths_.width_em(kUsualFigure) +
              double(count - 1) * kBetweenFigures_em) *
             sizes_.text;
    };
    has_figures_ = !moving_.empty() && room_.width() >= width(moving_.size());
    if (has_figures_ || moving_.size() > kAlwaysFigures || moving_.empty()) return;
    throw UsageError("show.overlays",
                     fmt::format("the velocities need {:.0f} pixels beside the wall, and there "
                                 "are {:.0f}; leave out 'velocities', or make the frame wider",
                                 width(moving_.size()), std::max(0.0, room_.width())),
                     exact_text(Overlay::velocities));
  }

  /// From left to right. A block that has left the frame has no figure: half a figure would be
  /// another number.
  std::vector<Figure> figures_of(const FrameState& shown) const {
    std::vector<Figure> figures;
    for (const std::size_t body : moving_) {
      const double middle = layout_.at(shown.state.bodies[body].position[0], 0).x;
      const double half = layout_.width_px(body) / 2;
      if (middle + half <= 0 || middle - half >= layout_.visible_right_px) continue;
      std::string text = rounded_text(shown.state.bodies[body].velocity[0]);
      const double width = widths_.width_em(text) * sizes_.text;
      const Point at{std::min(middle - width / 2, room_.right - width),
                     foot_px_ - kVelocityBaseline * sizes_.short_side};
      figures.push_back({body,
                         {nth(arrow_id(body, layout_.shapes.size()), 2), at, std::move(text),
                          sizes_.text, text_color_, font_face_},
                         width});
    }
    std::ranges::sort(figures, {}, [&](const Figure& figure) {
      return shown.state.bodies[figure.body].position[0];
    });
    keep_apart(figures, room_, kBetweenFigures_em * sizes_.text);
    return figures;
  }

  Layout layout_;
  std::vector<BlockColors> colors_;
  Color text_color_;
  Face font_face_;
  TextWidths widths_;
  ArrowLengths lengths_;
  Sizes sizes_;
  std::vector<std::size_t> moving_;  ///< bodies that collisions move, from the last to the first
  bool has_figures_ = true;
  Columns room_;        ///< of figures
  double foot_px_ = 0;  ///< arrows and figures are above it
};

class DiscArrows {
 public:
  explicit DiscArrows(const DrawingContext& context)
      : layout_(context.layout),
        color_(context.palette.text),
        line_px_(context.sizes.data_line),
        head_px_(kHead * context.sizes.short_side) {
    Rational mass = 0;
    for (const Body& body : context.scene.system.bodies) {
      if (body.mass) mass += *body.mass;
    }
    const Rational energy = most_twice_energy(context.scene, context.log);
    if (energy == 0) return;
    const mpf_class usual_speed = root_of(energy / mass);
    px_per_speed_ = mpf_class(kDiscArrow * context.sizes.short_side / usual_speed).get_d();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    if (px_per_speed_ == 0) return;
    for (std::size_t i = 0; i < shown.state.bodies.size(); ++i) {
      const auto& [position, velocity] = shown.state.bodies[i];
      const Point way{velocity[0] * px_per_speed_, -velocity[1] * px_per_speed_};
      const double length_px = length(way);
      if (!(length_px > 0 && length_px < HUGE_VAL)) continue;
      const Point centre = layout_.at(position);
      const double from = layout_.width_px(i) / 2 / length_px;
      add_arrow({nth(ItemId::velocities, kIds * i), centre + from * way, centre + (from + 1) * way,
                 color_, line_px_, head_px_, head_px_ / 2},
                items);
    }
  }

 private:
  Layout layout_;
  Color color_;
  double line_px_;
  double head_px_;
  double px_per_speed_ = 0;
};

}  // namespace

ArrowLengths::ArrowLengths(const Scene& scene, const Log& log, const Layout& layout) {
  const System& system = scene.system;
  // The heaviest block's speed when it has all the energy. It may be below the range of a double.
  const Rational most = heaviest_mass(system);
  if (most > 0) usual_speed_ = root_of(most_twice_energy(scene, log) / most);
  const std::vector<std::size_t> order = from_left_to_right(system);
  double narrowest = layout.shapes[order.front()].width * 2;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const double widths = layout.shapes[order[i - 1]].width + layout.shapes[order[i]].width;
    narrowest = i == 1 ? widths : std::min(narrowest, widths);
  }
  longest_px_ = kLongest * narrowest / 2 * layout.scale;
}

double ArrowLengths::length_px(double velocity) const {
  const double speed = std::abs(velocity);
  if (!(usual_speed_ > 0) || !(speed > 0)) return 0;
  const double share = 1 / (1 + kHalfLength * mpf_class(usual_speed_ / speed).get_d());
  return std::copysign(share * longest_px_, velocity);
}

double ArrowLengths::px_per_speed() const {
  if (!(usual_speed_ > 0)) return 0;
  const double scale = mpf_class(longest_px_ / (kHalfLength * usual_speed_)).get_d();
  return std::isfinite(scale) ? scale : 0;
}

std::optional<std::array<Point, 2>> arrow_in(const DrawList& list, std::size_t block,
                                             std::size_t count) {
  const ItemId id = arrow_id(block, count);
  std::array<Point, 2> ends;
  std::size_t found = 0;
  for (const DrawItem& item : list.items) {
    const auto* const path = std::get_if<PathItem>(&item);
    if (path == nullptr || (path->id != id && path->id != nth(id, 1))) continue;
    ends.at(path->id == id ? 0 : 1) = path->points.view().front();
    ++found;
  }
  return found == 2 ? std::optional(ends) : std::nullopt;
}

double room_above_px(const LayoutContext& context, const Layout& layout) {
  const bool has_label = !labelled_above(context, layout).empty();
  return (has_label ? label_room_px(context.sizes) : 0) +
         (context.scene.show.has(Overlay::velocities) ? arrow_room_px(context.sizes) : 0);
}

Drawable velocity_arrows(const DrawingContext& context) {
  if (context.is_plane()) return {DiscArrows(context)};
  return {BlockArrows(context)};
}

}  // namespace piblocks
