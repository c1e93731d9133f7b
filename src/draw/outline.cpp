#include <algorithm>
#include <array>
#include <vector>

#include "draw/painter.hpp"

namespace piblocks {
namespace {

/// Farthest that an arc is from its polygon.
constexpr double kTolerance_px = 1.0 / 64;
/// Sides of two pieces of a line that are as near as this need no joint.
constexpr double kNoJoint_px = 1.0 / 64;

Point with_length(const Point& a, double wanted) { return (wanted / length(a)) * a; }

/// Visits points of an arc in order, without its ends.
/// @param from, to  from the centre, of length `radius`, at most a half turn apart
/// @param middle    in the direction of the arc's middle
template <typename Visit>
void for_each_arc_point(const Point& from, const Point& to, const Point& middle, double radius,
                        const Visit& visit) {
  const Point chord = to - from;
  // The distance of an arc from its chord is chord^2 / (8 radius) or a little more.
  if (dot(chord, chord) <= 8 * radius * kTolerance_px) return;
  const Point half = with_length(middle, radius);
  for_each_arc_point(from, half, from + half, radius, visit);
  visit(half);
  for_each_arc_point(half, to, half + to, radius, visit);
}

void add_polygon(cairo_t& cr, std::span<const Point> points) {
  cairo_new_sub_path(&cr);
  for (const Point& point : points) cairo_line_to(&cr, point.x, point.y);
  cairo_close_path(&cr);
}

/// The outline of one line without dashes: a rectangle for each piece and a wedge for each joint.
/// All of them turn the same way, so none cancels another.
class LineOutline {
 public:
  LineOutline(std::span<const Point> points, double width_px)
      : points_(points), radius_(width_px / 2) {}

  void add(cairo_t& cr, bool closed) {
    const std::size_t pieces = closed ? points_.size() : points_.size() - 1;
    if (!closed) add_end(0, offset(0));
    for (std::size_t i = closed ? 0 : 1; i < pieces; ++i) {
      add_joint(i, (i + points_.size() - 1) % points_.size());
    }
    if (!closed) add_end(pieces, offset(pieces - 1));
    std::ranges::reverse(other_side_);
    if (closed) {
      add_polygon(cr, one_side_);
    } else {
      other_side_.insert(other_side_.end(), one_side_.begin(), one_side_.end());
    }
    add_polygon(cr, other_side_);
  }

 private:
  Point step(std::size_t piece) const {
    return points_[(piece + 1) % points_.size()] - points_[piece];
  }
  /// From the middle of a piece to its one side.
  Point offset(std::size_t piece) const { return turned_right(with_length(step(piece), radius_)); }
  void add_end(std::size_t at, const Point& offset) {
    one_side_.push_back(points_[at] + offset);
    other_side_.push_back(points_[at] - offset);
  }

  /// Between the piece that ends at a point, `before`, and the one that begins there.
  void add_joint(std::size_t at, std::size_t before) {
    const Point from = offset(before);
    const Point to = offset(at);
    if (length(to - from) <= kNoJoint_px) return add_end(at, to);
    const bool bends_to_one_side = dot(from, step(at)) > 0;
    const double sign = bends_to_one_side ? -1 : 1;
    std::vector<Point>& outer = bends_to_one_side ? other_side_ : one_side_;
    std::vector<Point>& inner = bends_to_one_side ? one_side_ : other_side_;
    const Point& centre = points_[at];
    outer.push_back(centre + sign * from);
    for_each_arc_point(sign * from, sign * to, middle_of_joint(at, before, sign * (from + to)),
                       radius_, [&](const Point& p) { outer.push_back(centre + p); });
    outer.push_back(centre + sign * to);
    inner.push_back(centre - sign * from);
    inner.push_back(centre);
    inner.push_back(centre - sign * to);
  }

  /// Where a line turns back, the sum of the two sides is nearly nothing, and the difference of the
  /// two directions is not.
  Point middle_of_joint(std::size_t at, std::size_t before, const Point& sum) const {
    if (dot(sum, sum) > radius_ * radius_) return sum;
    return with_length(step(before), 1) - with_length(step(at), 1);
  }

  std::span<const Point> points_;
  double radius_;
  std::vector<Point> one_side_;
  std::vector<Point> other_side_;
};

/// Hands out the dashes of a line.
template <typename Visit>
void for_each_dash(std::span<const Point> points, double dash_px, const Visit& visit) {
  std::vector<Point> dash = {points.front()};
  bool is_drawn = true;
  double left_px = dash_px;  // of the dash or gap
  for (std::size_t i = 1; i < points.size(); ++i) {
    Point at = points[i - 1];
    double rest_px = length(points[i] - at);
    while (rest_px > left_px) {
      at = on_way(at, points[i], left_px / rest_px);
      rest_px -= left_px;
      left_px = dash_px;
      dash.push_back(at);
      if (is_drawn) visit(dash);
      is_drawn = !is_drawn;
      dash = {at};
    }
    left_px -= rest_px;
    dash.push_back(points[i]);
  }
  if (is_drawn) visit(dash);
}

std::vector<Point> without_repeats(std::span<const Point> points, bool closed) {
  std::vector<Point> distinct(points.begin(), points.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  while (closed && distinct.size() > 1 && distinct.front() == distinct.back()) distinct.pop_back();
  return distinct;
}

}  // namespace

void add_line_outline(cairo_t& cr, std::span<const Point> points, bool closed, double width_px,
                      double dash_px) {
  std::vector<Point> distinct = without_repeats(points, closed);
  if (distinct.size() < 2) return;
  if (dash_px <= 0) return LineOutline(distinct, width_px).add(cr, closed);
  if (closed) distinct.push_back(distinct.front());
  for_each_dash(distinct, dash_px, [&](const std::vector<Point>& dash) {
    const std::vector<Point> pieces = without_repeats(dash, false);
    if (pieces.size() > 1) LineOutline(pieces, width_px).add(cr, false);
  });
}

void add_circle(cairo_t& cr, const Point& centre, double radius_px, Winding winding) {
  const double r = radius_px;
  const double down = winding == Winding::clockwise ? r : -r;
  const std::array<Point, 5> quarters{{{r, 0}, {0, down}, {-r, 0}, {0, -down}, {r, 0}}};
  std::vector<Point> points;
  const auto add = [&](const Point& p) { points.push_back(centre + p); };
  for (std::size_t i = 0; i < 4; ++i) {
    const Point& from = quarters.at(i);
    const Point& to = quarters.at(i + 1);
    add(from);
    for_each_arc_point(from, to, from + to, r, add);
  }
  add_polygon(cr, points);
}

}  // namespace piblocks
