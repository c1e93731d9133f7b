#include "draw/bodies/body_stage.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/rounded.hpp"
#include "draw/bodies/body_look.hpp"
#include "draw/look.hpp"
#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/text_lines.hpp"

namespace piblocks {
namespace {

// In fractions of the frame's shorter side.
constexpr double kLeastHeight = 0.05;
constexpr double kTallest = 0.5;
constexpr double kWallAbove = 0.03;  ///< of the tallest block
constexpr double kHatchStep = 0.02;
constexpr double kAboveBlock = 0.014;  ///< from a block to the label above it
/// A block is higher by this for every factor of ten in mass, in heights of the lightest.
constexpr double kHeightByMass = 0.25;
/// Part of a body's width or diameter that its label may take.
constexpr double kLabelRoom = 0.86;
/// Above a capital letter's half height, in ems.
constexpr double kHalfFigure_em = 0.36;
constexpr double kMostStep_px = 0.25;
/// Length of the arrow of the usual speed, of an arrow's head, and from a block to its arrow.
constexpr double kArrow = 0.08;
constexpr double kArrowHead = 0.014;
constexpr double kArrowAbove = 0.03;
/// Above the ids of labels, two for each body.
constexpr std::size_t kArrows = 32768;
/// More bodies have no labels, masses or arrows, nor are more drawn at all.
constexpr std::size_t kMostMarked = 10'000;
constexpr std::size_t kMostDrawn = 50'000;
/// Above the ids of walls.
constexpr std::size_t kTrails = 2000;
constexpr double kTrailOpacity = 0.45;
/// A disc whose radius is less than so many widths of its rim has none.
constexpr double kLeastRim = 4;

/// Where scene coordinates are in the frame.
struct BodyMap {
  double scale = 1;  ///< pixels per unit
  Point origin;      ///< of the scene's (0, 0)

  Point at(const std::array<double, 2>& position) const {
    return {origin.x + position[0] * scale, origin.y - position[1] * scale};
  }
};

struct BodyShape {
  double half_width_px = 0;  ///< or the radius
  double height_px = 0;      ///< of a block
  BodyColors colors;
  std::string label;
  double label_px = 0;       ///< width
  bool is_label_on = false;  ///< on the body, not above it
};

/// A frame's piece of hatched wall: a line along the face, and short lines behind it.
/// @param from, to  ends of the face; the wall is on the right of this way
std::vector<DrawItem> hatched(const Point& from, const Point& to, const DrawingContext& context) {
  const Sizes& sizes = context.sizes;
  const double length =
      std::sqrt((to.x - from.x) * (to.x - from.x) + (to.y - from.y) * (to.y - from.y));
  const Point along{(to.x - from.x) / length, (to.y - from.y) / length};
  const Point out{-along.y, along.x};
  const double width = style::kWallWidth * sizes.short_side;
  std::vector<DrawItem> items;
  const auto place = [&](double a, double b) {
    return Point{from.x + a * along.x + b * out.x, from.y + a * along.y + b * out.y};
  };
  for (double s = 0; s < length + width; s += kHatchStep * sizes.short_side) {
    const double begin = std::max(0.0, s - length);
    const double end = std::min(width, s);
    if (end <= begin) continue;
    items.emplace_back(PathItem{nth(ItemId::wall, items.size()),
                                std::vector<Point>{place(s - begin, begin), place(s - end, end)},
                                false, std::nullopt,
                                Stroke{context.palette.muted, sizes.grid_line}});
  }
  const double half = sizes.wall_line / 2;
  items.emplace_back(PathItem{nth(ItemId::wall, items.size()),
                              std::vector<Point>{place(-half, half), place(length + half, half)},
                              false, std::nullopt, Stroke{context.palette.wall, sizes.wall_line}});
  return items;
}

/// How velocities are drawn.
struct ArrowLook {
  bool are_shown = false;
  Color color;
  double px_per_speed = 0;
  double line_px = 1;
  double head_px = 1;
  double above_px = 0;  ///< from a block to its arrow
};

/// Draws one body after the other.
struct BodyPainter {
  std::vector<BodyShape> shapes;
  BodyMap map;
  bool are_blocks = true;
  double line_px = 1;
  double type_px = 16;  ///< of labels
  double above_px = 0;  ///< from a body to the label above it
  Color text;           ///< of labels that are above
  Face face = Face::text;

  void add(std::size_t body, const BodyMotion& motion, std::vector<DrawItem>& items,
           std::vector<DrawItem>& labels) const {
    const BodyShape& shape = shapes[body];
    const Point centre = map.at(motion.position);
    const ItemId id = nth(ItemId::red_block, body);
    const Stroke edge{shape.colors.edge, line_px};
    const double inside = shape.half_width_px - line_px / 2;
    if (are_blocks) {
      const Rectangle bounds{centre.x - shape.half_width_px, centre.y - shape.height_px,
                             2 * shape.half_width_px, shape.height_px};
      items.emplace_back(RectangleItem{id, bounds, shape.colors.fill, edge});
    } else if (inside > kLeastRim * line_px) {
      items.emplace_back(DiskItem{id, centre, inside, shape.colors.fill, edge});
    } else {
      items.emplace_back(
          DiskItem{id, centre, shape.half_width_px, shape.colors.fill, std::nullopt});
    }
    if (!shape.label.empty()) labels.emplace_back(label_of(body, centre));
  }

  TextItem label_of(std::size_t body, const Point& centre) const {
    const BodyShape& shape = shapes[body];
    const double middle = are_blocks ? centre.y - shape.height_px / 2 : centre.y;
    const double top = centre.y - (are_blocks ? shape.height_px : shape.half_width_px);
    const double baseline = shape.is_label_on ? middle + kHalfFigure_em * type_px : top - above_px;
    return {nth(ItemId::blue_block, body),
            {std::round(centre.x - shape.label_px / 2), std::round(baseline)},
            shape.label,
            type_px,
            shape.is_label_on ? shape.colors.text : text,
            face};
  }
};

class BodyStage {
 public:
  BodyStage(const DrawingContext& context, const Rectangle& area)
      : context_(context), system_(context.scene.bodies->system), area_(area) {
    check_number();
    context.needs.trails = context.scene.show.has(Overlay::trails);
    if (system_.dimensions == 2) {
      window_ = {std::ceil(area.x), std::ceil(area.y), std::floor(area.width - 1),
                 std::floor(area.height - 1)};
      area_ = {0, 0, window_.width, window_.height};
    }
    if (system_.dimensions == 1) {
      lay_out_line();
    } else {
      lay_out_plane();
    }
    check_scale();
    add_labels();
  }

  /// Discs that leave what is shown are cut off at its edge, so that they hide no text.
  Drawable drawable() && {
    if (system_.dimensions == 1) return bodies();
    return [inside = bodies(), window = window_, background = background_of(context_.scene.view)](
               const FrameState& shown, std::vector<DrawItem>& items) {
      DrawList list{int(window.width), int(window.height), background, {}};
      inside(shown, list.items);
      items.emplace_back(
          GroupItem{ItemId::wall, window, std::make_shared<const DrawList>(std::move(list))});
    };
  }

 private:
  Drawable bodies() {
    std::vector<DrawItem> stays;
    add_walls(stays);
    const Sizes& sizes = context_.sizes;
    const bool are_blocks = system_.dimensions == 1;
    const BodyPainter painter{.shapes = std::move(shapes_),
                              .map = map_,
                              .are_blocks = are_blocks,
                              .line_px = std::max(1.0, std::round(sizes.data_line)),
                              .type_px = sizes.mass,
                              .above_px = kAboveBlock * sizes.short_side,
                              .text = context_.palette.text,
                              .face = context_.font.face()};
    return [stays = std::move(stays), painter, arrows = arrow_look()](
               const FrameState& shown, std::vector<DrawItem>& items) {
      items.insert(items.end(), stays.begin(), stays.end());
      add_trails(shown.trails, painter.shapes, painter.map, items);
      std::vector<DrawItem> labels;
      for (std::size_t i = 0; i < shown.bodies.size(); ++i) {
        painter.add(i, shown.bodies[i], items, labels);
      }
      items.insert(items.end(), labels.begin(), labels.end());
      if (!arrows.are_shown) return;
      for (std::size_t i = 0; i < shown.bodies.size(); ++i) {
        Point from = painter.map.at(shown.bodies[i].position);
        if (painter.are_blocks) from.y -= painter.shapes[i].height_px + arrows.above_px;
        add_arrow(arrows, nth(ItemId::blue_block, kArrows + 2 * i), from, shown.bodies[i].velocity,
                  items);
      }
    };
  }

  ArrowLook arrow_look() const {
    double energy = 0;
    double mass = 0;
    for (const Body& body : system_.bodies) {
      if (!body.mass) continue;
      const auto& [x, y] = body.velocity;
      energy += to_double(*body.mass * (x * x + y * y));
      mass += to_double(*body.mass);
    }
    const double usual_speed = std::sqrt(energy / mass);
    return {.are_shown = context_.scene.show.has(Overlay::velocities) && usual_speed > 0,
            .color = context_.palette.text,
            .px_per_speed = kArrow * context_.sizes.short_side / usual_speed,
            .line_px = context_.sizes.data_line,
            .head_px = kArrowHead * context_.sizes.short_side,
            .above_px = kArrowAbove * context_.sizes.short_side};
  }

  /// A line and a triangle; nothing where the arrow would be shorter than its head.
  static void add_arrow(const ArrowLook& look, ItemId id, const Point& from,
                        const std::array<double, 2>& velocity, std::vector<DrawItem>& items) {
    const Point way{velocity[0] * look.px_per_speed, -velocity[1] * look.px_per_speed};
    const double length = std::sqrt(way.x * way.x + way.y * way.y);
    if (length < look.head_px) return;
    const Point along{way.x / length, way.y / length};
    const Point tip{from.x + way.x, from.y + way.y};
    const Point neck{tip.x - look.head_px * along.x, tip.y - look.head_px * along.y};
    const double half = look.head_px / 2;
    items.emplace_back(PathItem{id, std::vector<Point>{from, neck}, false, std::nullopt,
                                Stroke{look.color, look.line_px}});
    items.emplace_back(
        PathItem{nth(id, 1),
                 std::vector<Point>{tip,
                                    {neck.x - half * along.y, neck.y + half * along.x},
                                    {neck.x + half * along.y, neck.y - half * along.x}},
                 true, look.color, std::nullopt});
  }

  /// Lines behind discs, fainter the longer ago. They end where the disc is.
  static void add_trails(const std::vector<std::vector<std::array<double, 2>>>& trails,
                         const std::vector<BodyShape>& shapes, const BodyMap& map,
                         std::vector<DrawItem>& items) {
    std::size_t n = kTrails;
    for (std::size_t i = 0; i < trails.size(); ++i) {
      std::vector<Point> points;
      for (const auto& position : trails[i]) points.push_back(map.at(position));
      const double width_px = std::clamp(shapes[i].half_width_px / 2, 1.0, 6.0);
      items.emplace_back(PathItem{nth(ItemId::wall, n++), std::move(points), false, std::nullopt,
                                  Stroke{faded(shapes[i].colors.fill, kTrailOpacity), width_px}});
    }
  }

  void check_number() const {
    const Show& show = context_.scene.show;
    const bool is_marked = show.has(Overlay::velocities) || has_labels();
    const std::size_t most = is_marked ? kMostMarked : kMostDrawn;
    if (system_.bodies.size() <= most) return;
    throw UsageError(fmt::format("body: {} of them cannot be drawn{}; use at most {}",
                                 system_.bodies.size(),
                                 is_marked ? " with labels, masses or velocities" : "", most));
  }

  bool has_labels() const {
    return context_.scene.show.has(Overlay::masses) ||
           std::ranges::any_of(context_.scene.bodies->styles,
                               [](const BodyStyle& style) { return !style.label.empty(); });
  }

  double wall_px() const {
    return system_.walls.empty() ? 0 : style::kWallWidth * context_.sizes.short_side;
  }

  void lay_out_line() {
    const Sizes& sizes = context_.sizes;
    const View& view = context_.scene.view;
    const double left = area_.x + (system_.walls.empty() ? 0 : wall_px());
    const double width = area_.width - 2 * (left - area_.x);
    map_.scale = width / to_double(view.x.high - view.x.low);
    map_.origin.x = left - to_double(view.x.low) * map_.scale;
    double labels = has_labels() ? sizes.mass + kAboveBlock * sizes.short_side : 0;
    if (context_.scene.show.has(Overlay::velocities)) labels += kArrowAbove * sizes.short_side;
    const double room = area_.height - 2 * sizes.wall_line - labels - kWallAbove * sizes.short_side;
    if (room < kLeastHeight * sizes.short_side) throw_too_small();
    set_heights(std::min(room, kTallest * sizes.short_side));
    const double tallest = std::ranges::max_element(shapes_, {}, &BodyShape::height_px)->height_px;
    map_.origin.y = std::floor(area_.y + area_.height - 2 * sizes.wall_line - (room - tallest) / 2);
  }

  /// Blocks are as high as the widest is wide, and higher by their mass.
  void set_heights(double most_px) {
    std::optional<Rational> least;
    Rational widest = 0;
    for (const Body& body : system_.bodies) {
      if (body.mass && (!least || *body.mass < *least)) least = *body.mass;
      widest = std::max(widest, body.size);
    }
    double tallest = 1;
    std::vector<double> heights;
    for (const Body& body : system_.bodies) {
      double height = style::kMaxHeightRatio;
      if (body.mass) {
        const Magnitude ratio = magnitude_of(*body.mass / *least);
        const double logarithm = rounded::log10(ratio.mantissa) + double(ratio.exponent);
        height = std::min(height, 1 + kHeightByMass * logarithm);
      }
      heights.push_back(height);
      tallest = std::max(tallest, height);
    }
    const double unit = std::min(to_double(widest) * map_.scale, most_px / tallest);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      BodyShape& shape = shapes_.emplace_back();
      shape.half_width_px = to_double(system_.bodies[i].size) * map_.scale / 2;
      shape.height_px = std::max(1.0, std::floor(heights[i] * unit));
      shape.colors = body_colors(context_.scene, context_.palette, i);
    }
  }

  void lay_out_plane() {
    const View& view = context_.scene.view;
    const double margin = wall_px();
    const double width = area_.width - 2 * std::max(margin, context_.sizes.margin / 2);
    const double height = area_.height - 2 * std::max(margin, context_.sizes.margin / 2);
    if (std::min(width, height) < kLeastHeight * context_.sizes.short_side) throw_too_small();
    const double units_x = to_double(view.x.high - view.x.low);
    const double units_y = to_double(view.y.high - view.y.low);
    map_.scale = std::min(width / units_x, height / units_y);
    map_.origin = {
        area_.x + area_.width / 2 - to_double(view.x.high + view.x.low) / 2 * map_.scale,
        area_.y + area_.height / 2 + to_double(view.y.high + view.y.low) / 2 * map_.scale};
    map_.origin = {std::round(map_.origin.x), std::round(map_.origin.y)};
    for (std::size_t i = 0; i < system_.bodies.size(); ++i) {
      BodyShape& shape = shapes_.emplace_back();
      shape.half_width_px = to_double(system_.bodies[i].size) * map_.scale;
      shape.colors = body_colors(context_.scene, context_.palette, i);
    }
  }

  void check_scale() const {
    if (system_.dimensions == 1) return check_resolution(context_.scene.view, map_.scale);
    const View& view = context_.scene.view;
    const double farthest =
        std::max({std::fabs(to_double(view.x.low)), std::fabs(to_double(view.x.high)),
                  std::fabs(to_double(view.y.low)), std::fabs(to_double(view.y.high))});
    if (farthest * 0x1p-52 * map_.scale <= kMostStep_px) return;
    throw UsageError(
        "view.x: so far from 0 positions cannot be told apart by a pixel; show more of the plane, "
        "or move the bodies towards 0");
  }

  [[noreturn]] void throw_too_small() const {
    throw UsageError(fmt::format(
        "show: there is too little room for the bodies in {}x{}; leave something out, or make the "
        "frame larger",
        context_.scene.view.width_px, context_.scene.view.height_px));
  }

  /// What is written on each body: its label, or its mass.
  void add_labels() {
    const double size_px = context_.sizes.mass;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      BodyShape& shape = shapes_[i];
      shape.label = context_.scene.bodies->styles[i].label;
      const auto& mass = system_.bodies[i].mass;
      if (shape.label.empty() && mass && context_.scene.show.has(Overlay::masses)) {
        shape.label = short_text(*mass);
      }
      if (shape.label.empty()) continue;
      check_readable(context_, "body.label", shape.label);
      shape.label_px = context_.font.width_em(shape.label) * size_px;
      const double height = system_.dimensions == 1 ? shape.height_px : shape.half_width_px;
      shape.is_label_on =
          shape.label_px <= 2 * kLabelRoom * shape.half_width_px && size_px <= kLabelRoom * height;
    }
  }

  void add_walls(std::vector<DrawItem>& items) const {
    if (system_.dimensions == 1) {
      add_floor(items);
    } else {
      add_box(items);
    }
  }

  void add_plate(std::vector<DrawItem> wall, std::vector<DrawItem>& items) const {
    Rectangle bounds;
    bool is_first = true;
    for (const DrawItem& item : wall) {
      const Rectangle& part = std::get<PathItem>(item).points.bounds();
      if (is_first) bounds = part;
      is_first = false;
      const double right = std::max(bounds.x + bounds.width, part.x + part.width);
      const double bottom = std::max(bounds.y + bounds.height, part.y + part.height);
      bounds.x = std::min(bounds.x, part.x);
      bounds.y = std::min(bounds.y, part.y);
      bounds.width = right - bounds.x;
      bounds.height = bottom - bounds.y;
    }
    const double line = context_.sizes.wall_line;
    items.emplace_back(PlateItem{nth(ItemId::wall, 1000 + items.size()), whole_pixels(bounds, line),
                                 std::make_shared<const Plate>(Plate{std::move(wall)})});
  }

  void add_floor(std::vector<DrawItem>& items) const {
    const double line = context_.sizes.wall_line;
    const double tallest = std::ranges::max_element(shapes_, {}, &BodyShape::height_px)->height_px;
    const double top = map_.origin.y - tallest - kWallAbove * context_.sizes.short_side;
    double left = area_.x;
    double right = area_.x + area_.width;
    for (const Wall& wall : system_.walls) {
      const double face = map_.at({to_double(wall.point[0]), 0}).x;
      const double bottom = map_.origin.y + line;
      if (wall.normal[0] > 0) {
        add_plate(hatched({face, top}, {face, bottom}, context_), items);
        left = std::max(left, face - line);
      } else {
        add_plate(hatched({face, bottom}, {face, top}, context_), items);
        right = std::min(right, face + line);
      }
    }
    if (right <= left) return;
    items.emplace_back(RectangleItem{nth(ItemId::wall, 1000 + items.size()),
                                     {left, map_.origin.y, right - left, line},
                                     context_.palette.wall,
                                     std::nullopt});
  }

  /// The part of each wall that the area shows, as far as the walls beside it.
  void add_box(std::vector<DrawItem>& items) const {
    const View& view = context_.scene.view;
    for (const Wall& wall : system_.walls) {
      // Along the wall, with the bodies on the left.
      const std::array<double, 2> way = {to_double(wall.normal[1]), -to_double(wall.normal[0])};
      const std::array<double, 2> point = {to_double(wall.point[0]), to_double(wall.point[1])};
      double from = -HUGE_VAL;
      double to = HUGE_VAL;
      const auto cut = [&](double along, double distance) {
        // distance + along * s >= 0
        if (along > 0) from = std::max(from, -distance / along);
        if (along < 0) to = std::min(to, -distance / along);
      };
      for (const Wall& other : system_.walls) {
        if (&other == &wall) continue;
        const std::array<double, 2> normal = {to_double(other.normal[0]),
                                              to_double(other.normal[1])};
        cut(way[0] * normal[0] + way[1] * normal[1],
            (point[0] - to_double(other.point[0])) * normal[0] +
                (point[1] - to_double(other.point[1])) * normal[1]);
      }
      cut(way[0], point[0] - to_double(view.x.low));
      cut(-way[0], to_double(view.x.high) - point[0]);
      cut(way[1], point[1] - to_double(view.y.low));
      cut(-way[1], to_double(view.y.high) - point[1]);
      if (!(to > from)) continue;
      const Point begin = map_.at({point[0] + from * way[0], point[1] + from * way[1]});
      const Point end = map_.at({point[0] + to * way[0], point[1] + to * way[1]});
      add_plate(hatched(begin, end, context_), items);
    }
  }

  const DrawingContext& context_;
  const BodySystem& system_;
  Rectangle window_;  ///< in the frame, whole pixels; of discs
  Rectangle area_;    ///< in the frame; of discs, in the window
  BodyMap map_;
  std::vector<BodyShape> shapes_;
};

}  // namespace

Drawable body_stage(const DrawingContext& context, const Rectangle& area) {
  return BodyStage(context, area).drawable();
}

}  // namespace piblocks
