#include "draw/bodies/body_walls.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace piblocks {
namespace {

// In fractions of the frame's shorter side.
constexpr double kHatchStep = 0.02;
/// Above the ids of a wall's own lines.
constexpr std::size_t kPlates = 1000;

/// A frame's piece of hatched wall: a line along the face, and short lines behind it.
/// @param from, to  ends of the face; the wall is on the right of this way
std::vector<DrawItem> hatched(const Point& from, const Point& to, const DrawingContext& context) {
  const Sizes& sizes = context.sizes;
  const double length =
      std::sqrt((to.x - from.x) * (to.x - from.x) + (to.y - from.y) * (to.y - from.y));
  const Point along{(to.x - from.x) / length, (to.y - from.y) / length};
  const Point out{-along.y, along.x};
  const double width = style::kWallWidth * sizes.short_side;
  const double half = sizes.wall_line / 2;
  std::vector<DrawItem> items;
  const auto place = [&](double a, double b) {
    return Point{from.x + a * along.x + b * out.x, from.y + a * along.y + b * out.y};
  };
  for (double s = 0; s < length + width; s += kHatchStep * sizes.short_side) {
    // The face hides the corners of the line's end.
    const double begin = std::max(half, s - length);
    const double end = std::min(width, s);
    if (end <= begin) continue;
    items.emplace_back(PathItem{nth(ItemId::wall, items.size()),
                                std::vector<Point>{place(s - begin, begin), place(s - end, end)},
                                false, std::nullopt,
                                Stroke{context.palette.muted, sizes.grid_line}});
  }
  items.emplace_back(PathItem{nth(ItemId::wall, items.size()),
                              std::vector<Point>{place(-half, half), place(length + half, half)},
                              false, std::nullopt, Stroke{context.palette.wall, sizes.wall_line}});
  return items;
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

class BodyWalls {
 public:
  BodyWalls(const DrawingContext& context, const BodyShapes& bodies, const Rectangle& area)
      : context_(context), walls_(context.bodies.system.walls), bodies_(bodies), area_(area) {}

  std::vector<DrawItem> items() && {
    if (bodies_.are_blocks) {
      add_floor();
    } else {
      for (const Wall& wall : walls_) add_side(wall);
    }
    return std::move(items_);
  }

 private:
  void add_plate(std::vector<DrawItem> wall) {
    Rectangle bounds = std::get<PathItem>(wall.front()).points.bounds();
    for (const DrawItem& item : wall) {
      const Rectangle& part = std::get<PathItem>(item).points.bounds();
      const double right = std::max(bounds.x + bounds.width, part.x + part.width);
      const double bottom = std::max(bounds.y + bounds.height, part.y + part.height);
      bounds.x = std::min(bounds.x, part.x);
      bounds.y = std::min(bounds.y, part.y);
      bounds.width = right - bounds.x;
      bounds.height = bottom - bounds.y;
    }
    const double line = context_.sizes.wall_line;
    items_.emplace_back(PlateItem{nth(ItemId::wall, kPlates + items_.size()),
                                  whole_pixels(bounds, line),
                                  std::make_shared<const Plate>(Plate{std::move(wall)})});
  }

  void add_floor() {
    const double line = context_.sizes.wall_line;
    const double floor = bodies_.map.origin.y;
    const double top = floor - bodies_.tallest_px() - kWallAboveBodies * context_.sizes.short_side;
    double left = area_.x;
    double right = area_.x + area_.width;
    for (const Wall& wall : walls_) {
      const double face = bodies_.map.at({to_double(wall.point[0]), 0}).x;
      const double bottom = floor + line;
      if (wall.normal[0] > 0) {
        add_plate(hatched({face, top}, {face, bottom}, context_));
        left = std::max(left, face - line);
      } else {
        add_plate(hatched({face, bottom}, {face, top}, context_));
        right = std::min(right, face + line);
      }
    }
    if (right <= left) return;
    items_.emplace_back(RectangleItem{nth(ItemId::wall, kPlates + items_.size()),
                                      {left, floor, right - left, line},
                                      context_.palette.wall,
                                      std::nullopt});
  }

  /// What the area shows of a wall, as far as the walls beside it.
  void add_side(const Wall& wall) {
    // Along the wall, with the bodies on the left.
    const std::array<double, 2> way = {to_double(wall.normal[1]), -to_double(wall.normal[0])};
    const std::array<double, 2> point = {to_double(wall.point[0]), to_double(wall.point[1])};
    WallPart part;
    for (const Wall& other : walls_) {
      if (&other == &wall) continue;
      const std::array<double, 2> normal = {to_double(other.normal[0]), to_double(other.normal[1])};
      part.cut(way[0] * normal[0] + way[1] * normal[1],
               (point[0] - to_double(other.point[0])) * normal[0] +
                   (point[1] - to_double(other.point[1])) * normal[1]);
    }
    const View& view = context_.scene.view;
    part.cut(way[0], point[0] - to_double(view.x.low));
    part.cut(-way[0], to_double(view.x.high) - point[0]);
    part.cut(way[1], point[1] - to_double(view.y.low));
    part.cut(-way[1], to_double(view.y.high) - point[1]);
    if (!(part.to > part.from)) return;
    const auto at = [&](double s) {
      return bodies_.map.at({point[0] + s * way[0], point[1] + s * way[1]});
    };
    add_plate(hatched(at(part.from), at(part.to), context_));
  }

  const DrawingContext& context_;
  const std::vector<Wall>& walls_;
  const BodyShapes& bodies_;
  Rectangle area_;
  std::vector<DrawItem> items_;
};

}  // namespace

std::vector<DrawItem> body_walls(const DrawingContext& context, const BodyShapes& bodies,
                                 const Rectangle& area) {
  return BodyWalls(context, bodies, area).items();
}

}  // namespace piblocks
