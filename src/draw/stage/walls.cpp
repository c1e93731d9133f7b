#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/rounded.hpp"
#include "draw/number_text.hpp"
#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

/// Ids of walls that move come after those of all others.
constexpr std::size_t kMostRestingWalls = 1000;
/// In fractions of the frame's shorter side.
constexpr double kAngleArc = 0.2;
/// Between a wall's face and a text.
constexpr double kBesideWall_em = 0.25;
/// The same of an angle, which is behind the hatch.
constexpr double kBesideHatch_em = 0.6;

/// From places along a wall's face and behind it to pixels.
struct WallMap {
  WallMap(const Point& start, const Point& end)
      : from(start),
        to(end),
        length(piblocks::length(end - start)),
        along((end - start) / length) {}

  Point operator()(double on, double behind) const {
    return from + on * along + behind * turned_right(along);
  }
  /// Around a part of the wall.
  Rect bounds(double first, double last, double front, double back) const {
    const Points corners(
        {(*this)(first, front), (*this)(first, back), (*this)(last, front), (*this)(last, back)});
    return corners.bounds();
  }

  Point from;
  Point to;
  double length;
  Point along;
};

PlateItem face_plate(ItemId id, const Point& from, const Point& to, const DrawingContext& context,
                     const Hatch& hatch, double beyond_px = 0) {
  const double width = std::max(context.sizes.wall_line, hatch.width * context.sizes.short_side);
  const WallMap map(from, to);
  return plate_of(id, map.bounds(-1 - beyond_px, map.length + 1 + beyond_px, -1, width + 1),
                  hatched_face(from, to, context.palette, context.sizes, hatch, beyond_px));
}

/// Along a wall, from the first place to the second.
struct WallPart {
  double from = -HUGE_VAL;
  double to = HUGE_VAL;

  /// Leaves the places s where distance + along * s >= 0.
  void cut(double along, double distance) {
    if (along > 0) from = std::max(from, -distance / along);
    if (along < 0) to = std::min(to, -distance / along);
  }
};

Point to_doubles(const ExactVector& vector) { return {to_double(vector[0]), to_double(vector[1])}; }

/// What the view shows of a straight wall, as far as the walls beside it.
WallPart part_of(const Wall& wall, const std::vector<Wall>& walls, const View& view) {
  // Along the wall, with the bodies on the left.
  const Point way{to_double(wall.normal[1]), -to_double(wall.normal[0])};
  const Point point = to_doubles(wall.point);
  WallPart part;
  for (const Wall& other : walls) {
    if (&other == &wall) continue;
    const Point normal = to_doubles(other.normal);
    part.cut(dot(way, normal), dot(point - to_doubles(other.point), normal));
  }
  part.cut(way.x, point.x - to_double(view.x.low));
  part.cut(-way.x, to_double(view.x.high) - point.x);
  part.cut(way.y, point.y - to_double(view.y.low));
  part.cut(-way.y, to_double(view.y.high) - point.y);
  return part;
}

/// The angle between two walls, the second of which begins where the first ends. How large it is
/// stands behind the upper one.
void add_angle(const WallMap& first, const WallMap& second, const DrawingContext& context,
               std::vector<DrawItem>& items) {
  const Sizes& sizes = context.sizes;
  const auto turn_of = [](const Point& way) { return rounded::atan2(-way.y, way.x); };
  const double turn = turn_of(-1 * first.along);
  const double angle = std::remainder(turn_of(second.along) - turn, 2 * std::numbers::pi);
  const Circle circle{second.from, kAngleArc * sizes.short_side};
  items.emplace_back(line_item(nth(ItemId::wall, items.size()), circle.arc(turn, turn + angle),
                               {context.palette.text, sizes.grid_line}));
  const std::string text = fmt::format("{:.3g}°", std::abs(angle) * 180 / std::numbers::pi);
  const double width = context.font.width_em(text) * sizes.text;
  const Point end_of_first = first(first.length - circle.radius, 0);
  const Point end_of_second = second(circle.radius, 0);
  const bool is_first = end_of_first.y < end_of_second.y;
  const WallMap& upper = is_first ? first : second;
  const double behind = style::kWallWidth * sizes.short_side + kBesideHatch_em * sizes.text +
                        std::abs(upper.along.y) * width / 2 +
                        std::abs(upper.along.x) * sizes.text / 2;
  const Point centre = upper(is_first ? first.length - circle.radius : circle.radius, behind);
  const Point origin{centre.x - width / 2, centre.y + kHalfFigure_em * sizes.text};
  items.emplace_back(TextItem{nth(ItemId::wall, items.size()), origin, text, sizes.text,
                              context.palette.text, context.font.face()});
}

/// Nothing if the view does not show it. @param walls  beside it, which cut it off
std::optional<WallMap> face_in_plane(const Wall& wall, const std::vector<Wall>& walls,
                                     const View& view, const Layout& layout) {
  const WallPart part = part_of(wall, walls, view);
  if (!(part.to > part.from)) return std::nullopt;
  const auto at = [&](double s) {
    return layout.at(to_double(wall.point[0]) + s * to_double(wall.normal[1]),
                     to_double(wall.point[1]) - s * to_double(wall.normal[0]));
  };
  const WallMap map(at(part.from), at(part.to));
  return map.length > 0 ? std::optional(map) : std::nullopt;
}

/// Walls that move, where they are.
class MovingWalls {
 public:
  explicit MovingWalls(const DrawingContext& context)
      : walls_(context.scene.system.walls),
        view_(context.scene.view),
        layout_(context.layout),
        palette_(context.palette),
        sizes_(context.sizes),
        is_plane_(context.is_plane()) {}

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    std::vector<Wall> walls = walls_;
    for (Wall& wall : walls) {
      if (!is_moving(wall)) continue;
      for (const std::size_t axis : {0U, 1U}) {
        wall.point.at(axis) += wall.velocity.at(axis) * shown.time;
      }
    }
    std::size_t n = kMostRestingWalls;
    for (const Wall& wall : walls) {
      if (!is_moving(wall)) continue;
      for (DrawItem& item : items_of(wall, walls)) {
        std::visit([&](auto& any) { any.id = nth(ItemId::wall, n++); }, item);
        items.push_back(std::move(item));
      }
    }
  }

 private:
  std::vector<DrawItem> items_of(const Wall& wall, const std::vector<Wall>& walls) const {
    if (is_plane_) {
      const auto face = face_in_plane(wall, walls, view_, layout_);
      if (!face) return {};
      return hatched_face(face->from, face->to, palette_, sizes_, kWallHatch, sizes_.wall_line / 2);
    }
    if (wall.point[0] < view_.x.low || wall.point[0] > view_.x.high) return {};
    const double face = to_double(wall.point[0]);
    const int side = sgn(wall.normal[0]);
    if (view_.theme == Theme::article) {
      return {article_wall(layout_, view_, palette_.wall, face, side)};
    }
    const double x = layout_.at(face, 0).x;
    Point from{x, layout_.top_px() - kWallAbove * sizes_.short_side};
    Point to{x, layout_.wall_bottom_px};
    if (side < 0) std::swap(from, to);
    return hatched_face(from, to, palette_, sizes_, kWallHatch);
  }

  std::vector<Wall> walls_;
  View view_;
  Layout layout_;
  Palette palette_;
  Sizes sizes_;
  bool is_plane_;
};

std::vector<DrawItem> walls_of_plane(const DrawingContext& context) {
  std::vector<Wall> walls = context.scene.system.walls;
  std::erase_if(walls, is_moving);
  std::vector<DrawItem> items;
  std::vector<WallMap> seen;
  for (const Wall& wall : walls) {
    const auto face = face_in_plane(wall, walls, context.scene.view, context.layout);
    if (!face) continue;
    seen.push_back(*face);
    // The lines of walls that meet overlap.
    items.emplace_back(face_plate(nth(ItemId::wall, items.size()), face->from, face->to, context,
                                  kWallHatch, context.sizes.wall_line / 2));
  }
  if (!context.scene.show.has(Overlay::angles)) return items;
  constexpr double kSamePlace_px = 0.5;
  for (const WallMap& first : seen) {
    for (const WallMap& second : seen) {
      const bool do_meet = length(second.from - first(first.length, 0)) < kSamePlace_px;
      if (do_meet) add_angle(first, second, context, items);
    }
  }
  return items;
}

/// Walls at the ends of the floor. It goes on where there is none, but for a margin opposite a
/// wall.
std::vector<DrawItem> walls_of_line(const DrawingContext& context) {
  const Layout& layout = context.layout;
  const View& view = context.scene.view;
  const double line = context.sizes.wall_line;
  const double top = layout.top_px() - kWallAbove * context.sizes.short_side;
  const LineWalls all = line_walls(context.scene.system);
  const LineWalls seen = seen_walls(context.scene.system, view);
  double left = all.right && !all.left ? context.sizes.margin : 0;
  double right = all.left ? layout.content_right_px : layout.visible_right_px;
  std::vector<DrawItem> items;
  if (seen.left) {
    const double face = layout.at(to_double(*seen.left), 0).x;
    items.emplace_back(
        face_plate(ItemId::wall, {face, top}, {face, layout.wall_bottom_px}, context, kWallHatch));
    left = face - line;
  }
  if (seen.right) right = layout.at(to_double(*seen.right), 0).x + line;
  const Point floor_left{left, layout.floor_px};
  const Point floor_right{right, layout.floor_px};
  // A scale takes the place of the hatch.
  Hatch hatch = kFloorHatch;
  if (context.scene.show.has(Overlay::ruler)) hatch.width = 0;
  items.emplace_back(face_plate(nth(ItemId::wall, 1), floor_left, floor_right, context, hatch));
  if (seen.right) {
    const double face = right - line;
    items.emplace_back(face_plate(nth(ItemId::wall, 2), {face, layout.wall_bottom_px}, {face, top},
                                  context, kWallHatch));
  }
  return items;
}

}  // namespace

LineWalls line_walls(const System& system) {
  LineWalls walls;
  for (const Wall& wall : system.walls) {
    const Rational& face = wall.point[0];
    if (is_moving(wall)) continue;
    if (wall.normal[0] > 0) walls.left = walls.left ? std::max(*walls.left, face) : face;
    if (wall.normal[0] < 0) walls.right = walls.right ? std::min(*walls.right, face) : face;
  }
  return walls;
}

LineWalls seen_walls(const System& system, const View& view) {
  LineWalls walls = line_walls(system);
  if (walls.left && !(view.x.low <= *walls.left && *walls.left < view.x.high)) walls.left.reset();
  if (walls.right && !(view.x.low < *walls.right && *walls.right <= view.x.high)) {
    walls.right.reset();
  }
  return walls;
}

Range seen_axis(const System& system, const View& view) {
  const LineWalls walls = line_walls(system);
  Range range = view.x;
  if (walls.left) range.low = std::max(range.low, *walls.left);
  if (walls.right) range.high = std::min(range.high, *walls.right);
  return range;
}

Columns text_columns(const DrawingContext& context) {
  const double margin = context.sizes.margin;
  return {margin, std::min(context.scene.view.width_px - margin, context.layout.content_right_px)};
}

Columns text_columns_between_walls(const DrawingContext& context) {
  const LineWalls walls = line_walls(context.scene.system);
  const double beside_px = kBesideWall_em * context.sizes.text;
  const auto face_px = [&](const Rational& face) {
    return context.layout.at(to_double(face), 0).x;
  };
  auto [left, right] = text_columns(context);
  if (walls.left) left = std::max(left, face_px(*walls.left) + beside_px);
  if (walls.right) right = std::min(right, face_px(*walls.right) - beside_px);
  return {left, right};
}

std::vector<DrawItem> hatched_face(const Point& from, const Point& to, const Palette& palette,
                                   const Sizes& sizes, const Hatch& hatch, double beyond_px) {
  const WallMap at(from, to);
  const double width = hatch.width * sizes.short_side;
  const double line = sizes.wall_line;
  // The face hides the corners of a hatch's end.
  const double nearest = std::min(line / 2, width / 2);
  // In the same direction on all walls and floors that are level or upright.
  const bool is_level = std::abs(at.along.x) > std::abs(at.along.y);
  const auto end_at = [&](double on, double behind) {
    return at(is_level ? at.length - on : on, behind);
  };
  std::vector<DrawItem> items;
  for (double s = 0; s < at.length + width; s += hatch.step * sizes.short_side) {
    // At 45 degrees, cut off at the wall's ends.
    const double begin = std::max(nearest, width - s);
    const double end = std::min(width, width + at.length - s);
    if (end <= begin) continue;
    items.emplace_back(line_item(nth(ItemId::wall, items.size()),
                                 {end_at(s - width + begin, begin), end_at(s - width + end, end)},
                                 {palette.muted, sizes.grid_line}));
  }
  const ItemId id = nth(ItemId::wall, items.size());
  const double last = at.length + beyond_px;
  if (at.along.x == 0 || at.along.y == 0) {
    items.emplace_back(RectangleItem{id, at.bounds(-beyond_px, last, 0, line), palette.wall});
  } else {
    items.emplace_back(
        line_item(id, {at(-beyond_px, line / 2), at(last, line / 2)}, {palette.wall, line}));
  }
  return items;
}

std::optional<Drawable> moving_walls(const DrawingContext& context) {
  if (std::ranges::none_of(context.scene.system.walls, is_moving)) return std::nullopt;
  return Drawable{MovingWalls(context)};
}

std::vector<DrawItem> stage_walls(const DrawingContext& context) {
  if (context.is_plane()) return walls_of_plane(context);
  return context.scene.view.theme == Theme::article ? article_walls(context)
                                                    : walls_of_line(context);
}

}  // namespace piblocks
