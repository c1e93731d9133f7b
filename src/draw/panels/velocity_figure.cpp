#include "draw/panels/velocity_figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/rounded.hpp"
#include "draw/look.hpp"

namespace piblocks {
namespace {

constexpr double kAxisReach_em = 0.4;  ///< beyond the circle
/// Chords on one side are at least so many data lines apart.
constexpr double kChordsApart = 3;
/// Radius of the dots of hits, at most, in parts of the length between two of them.
constexpr double kDotsApart = 0.3;
/// A narrower wedge cannot be seen.
constexpr double kLeastWedge_px = 0.5;
// Widths of lines, in those of the grid.
constexpr double kOutline = 1.5;
constexpr double kArcLine = 1.2;

/// Log of the drawn ellipse's axes, blue's over red's: the root of the mass ratio, within limits.
double log_axes_of(const TwoBlocks& system) {
  const Rational ratio = system.red.mass / system.blue.mass;
  const Rational most = kMostLongEllipse * kMostLongEllipse;
  return rounded::log(to_double(std::clamp<Rational>(ratio, 1 / most, most))) / 2;
}

/// Of a label's color. One part fades out before the other fades in.
double strength(VelocityPart part, double share) {
  constexpr double kArcsFrom = 0.9;
  const double visible = part == VelocityPart::ellipse ? 1 - 2 * share
                         : part == VelocityPart::arcs  ? (share - kArcsFrom) / (1 - kArcsFrom)
                                                       : 2 * share - 1;
  return std::clamp(visible, 0.0, 1.0);
}

/// From one angle of the circle to another.
std::vector<Point> curve(const VelocityMap& map, double from, double to) {
  std::vector<Point> points;
  for (const Point& point : Circle{{0, 0}, 1}.arc(from, to)) {
    points.push_back(map.at(Point{point.x, -point.y}));
  }
  return points;
}

}  // namespace

VelocityFigure::VelocityFigure(const DrawingContext& context, const Diagram& diagram,
                               VelocityPoints points)
    : points_(std::move(points)),
      palette_(context.palette),
      grid_px_(context.sizes.grid_line),
      log_axes_(log_axes_of(context.two_blocks().blocks())),
      place_(place_velocities(diagram, context.setter())) {
  const double apart_px = 2 * points_.wedge_angle() * place_.circle.radius;
  has_chords_ = points_.moves() && apart_px >= kChordsApart * context.sizes.data_line;
  if (has_chords_) angles_ = points_.all_angles();
  dot_px_ = std::min(style::kHitDot * context.sizes.short_side, kDotsApart * apart_px);
  written_ = label_velocities(context, place_, points_, angles_);
}

VelocityMap VelocityFigure::map(double share) const {
  const auto& [centre, radius] = place_.circle;
  const double shorter = radius * rounded::exp(-std::abs(log_axes_) * (1 - share));
  return log_axes_ > 0 ? VelocityMap{centre, shorter, radius}
                       : VelocityMap{centre, radius, shorter};
}

std::array<std::vector<Point>, 2> VelocityFigure::axes() const {
  const auto& [centre, radius] = place_.circle;
  const double reach = radius + kAxisReach_em * place_.em;
  return {{{{centre.x - reach, centre.y}, {centre.x + reach, centre.y}},
           {{centre.x, centre.y - reach}, {centre.x, centre.y + reach}}}};
}

std::vector<DrawItem> VelocityFigure::items(double share, ItemId first) const {
  std::vector<DrawItem> items;
  const auto add = [&](std::vector<Point> points, const Color& color, double width, bool closed) {
    items.emplace_back(PathItem{nth(first, items.size()), std::move(points), closed, std::nullopt,
                                Stroke{color, width * grid_px_}});
  };
  for (std::vector<Point>& axis : axes()) add(std::move(axis), palette_.grid, 1, false);
  if (points_.moves()) {
    std::vector<Point> outline = curve(map(share), 0, 2 * std::numbers::pi);
    outline.pop_back();
    add(std::move(outline), palette_.muted, kOutline, true);
  }
  add_labels(VelocityPart::ellipse, share, first, items);
  add_labels(VelocityPart::circle, share, first, items);
  return items;
}

std::vector<DrawItem> VelocityFigure::arc_items(double share, ItemId first) const {
  std::vector<DrawItem> items;
  const double visible = strength(VelocityPart::arcs, share);
  if (visible == 0 || written_.arc.empty()) return items;
  const Stroke stroke{faded(palette_.text, visible), kArcLine * grid_px_};
  items.emplace_back(PathItem{first, written_.arc, false, std::nullopt, stroke});
  add_labels(VelocityPart::arcs, share, first, items);
  return items;
}

std::vector<DrawItem> VelocityFigure::end_items(double share, ItemId first) const {
  std::vector<DrawItem> items;
  const double theta = points_.wedge_angle();
  const double visible = strength(VelocityPart::end, share);
  if (visible == 0 || !points_.moves()) return items;
  if (theta * place_.circle.radius >= kLeastWedge_px) {
    std::vector<Point> wedge = curve(map(share), 0, theta);
    wedge.push_back(place_.circle.centre);
    items.emplace_back(PathItem{first, std::move(wedge), true,
                                faded(palette_.done, style::kWedgeFill * visible), std::nullopt});
  }
  add_labels(VelocityPart::end, share, first, items);
  return items;
}

void VelocityFigure::add_labels(VelocityPart part, double share, ItemId first,
                                std::vector<DrawItem>& items) const {
  const double visible = strength(part, share);
  if (visible == 0) return;
  for (const VelocityLabel& label : written_.labels) {
    if (label.part != part) continue;
    label.formula.add_to(items, nth(first, items.size()), label.at, place_.em,
                         faded(label.color, visible));
  }
}

}  // namespace piblocks
