#include <piblocks/image.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/rounded.hpp"
#include "draw/extent.hpp"
#include "draw/painter.hpp"

namespace piblocks {
namespace {

/// Dashes along one side, fitted to end in each corner and to look the same from both ends.
void stroke_side(cairo_t& cr, const Point& from, const Point& to, double dash_px) {
  const double length = rounded::hypot(to.x - from.x, to.y - from.y);
  const double periods = std::max(1.0, std::round((length / dash_px - 1) / 2));
  const double fitted = length / (2 * periods + 1);
  cairo_set_dash(&cr, &fitted, 1, 0);
  cairo_move_to(&cr, from.x, from.y);
  cairo_line_to(&cr, to.x, to.y);
  cairo_stroke(&cr);
}

void stroke_inside(cairo_t& cr, const Rectangle& bounds, const Stroke& stroke) {
  // A shape thinner than its stroke is nothing but stroke.
  const double width_px = std::min({stroke.width_px, bounds.width, bounds.height});
  const double inset = width_px / 2;
  const double left = bounds.x + inset;
  const double top = bounds.y + inset;
  const double right = bounds.x + bounds.width - inset;
  const double bottom = bounds.y + bounds.height - inset;
  set_color(cr, stroke.color);
  cairo_set_line_width(&cr, width_px);
  if (stroke.dash_px <= 0 || width_px < stroke.width_px) {
    cairo_set_dash(&cr, nullptr, 0, 0);
    cairo_rectangle(&cr, left, top, right - left, bottom - top);
    cairo_stroke(&cr);
    return;
  }
  cairo_set_line_cap(&cr, CAIRO_LINE_CAP_SQUARE);
  const std::array<Point, 4> corners{{{left, top}, {right, top}, {right, bottom}, {left, bottom}}};
  for (std::size_t i = 0; i < 4; ++i) {
    stroke_side(cr, corners.at(i), corners.at((i + 1) % 4), stroke.dash_px);
  }
  cairo_set_line_cap(&cr, CAIRO_LINE_CAP_BUTT);
}

double within_reach(double px) { return std::clamp(px, -kFar_px, kFar_px); }

Rectangle within_reach(const Rectangle& r) {
  const double x = within_reach(r.x);
  const double y = within_reach(r.y);
  if (x == r.x && y == r.y && r.width <= kMaxSide_px && r.height <= kMaxSide_px) return r;
  return {x, y, within_reach(r.x + r.width) - x, within_reach(r.y + r.height) - y};
}

/// The fill of the current path, then its line, centred on it.
void fill_and_stroke(cairo_t& cr, const std::optional<Color>& fill,
                     const std::optional<Stroke>& stroke) {
  if (fill) {
    set_color(cr, *fill);
    cairo_fill_preserve(&cr);
  }
  if (stroke) {
    set_color(cr, stroke->color);
    cairo_set_line_width(&cr, stroke->width_px);
    cairo_set_dash(&cr, &stroke->dash_px, stroke->dash_px > 0 ? 1 : 0, 0);
    cairo_set_line_join(&cr, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_preserve(&cr);
    cairo_set_line_join(&cr, CAIRO_LINE_JOIN_MITER);
  }
  cairo_new_path(&cr);
}

/// The curves of cairo_arc(), whose sine and cosine are the C library's. Their distance from the
/// circle is at most Cairo's tolerance.
void add_circle(cairo_t& cr, const Point& centre, double radius) {
  // The error of 1, 2, … curves for half a turn, in parts of the radius: 2/27 sin^6(a/4) /
  // cos^2(a/4) for curves of the angle a.
  constexpr std::array kErrors{0.0185185185185185, 0.000272567143730180, 2.38647043651461e-05,
                               4.24554377432224e-06};
  const double tolerance = cairo_get_tolerance(&cr) / radius;
  std::size_t curves = 1;
  while (curves < kErrors.size() && kErrors.at(curves - 1) >= tolerance) ++curves;
  const double angle = std::numbers::pi / double(curves);
  const auto [quarter_sine, quarter_cosine] = rounded::sin_cos(angle / 4);
  const double handle = 4.0 / 3 * radius * (quarter_sine / quarter_cosine);
  const auto direction = [&](std::size_t index) {
    const auto [sine, cosine] = rounded::sin_cos(double(index) * angle);
    return Point{cosine, sine};
  };
  Point from = direction(0);
  cairo_move_to(&cr, centre.x + radius * from.x, centre.y + radius * from.y);
  for (std::size_t i = 1; i <= 2 * curves; ++i) {
    const Point to = direction(i);
    const Point end{centre.x + radius * to.x, centre.y + radius * to.y};
    cairo_curve_to(&cr, centre.x + radius * from.x - handle * from.y,
                   centre.y + radius * from.y + handle * from.x, end.x + handle * to.y,
                   end.y - handle * to.x, end.x, end.y);
    from = to;
  }
  cairo_close_path(&cr);
}

}  // namespace

void set_color(cairo_t& cr, const Color& color) {
  // An opaque source takes Cairo's faster ways.
  if (color.alpha == 255) {
    cairo_set_source_rgb(&cr, color.red / 255.0, color.green / 255.0, color.blue / 255.0);
  } else {
    cairo_set_source_rgba(&cr, color.red / 255.0, color.green / 255.0, color.blue / 255.0,
                          color.alpha / 255.0);
  }
}

void paint_shape(cairo_t& cr, const RectangleItem& item) {
  const Rectangle bounds = within_reach(item.bounds);
  if (item.fill) {
    set_color(cr, *item.fill);
    cairo_rectangle(&cr, bounds.x, bounds.y, bounds.width, bounds.height);
    cairo_fill(&cr);
  }
  if (item.stroke) stroke_inside(cr, bounds, *item.stroke);
}

void paint_shape(cairo_t& cr, const PathItem& item) {
  for (const Point& point : item.points.view()) {
    cairo_line_to(&cr, within_reach(point.x), within_reach(point.y));
  }
  if (item.closed) cairo_close_path(&cr);
  fill_and_stroke(cr, item.fill, item.stroke);
}

void paint_shape(cairo_t& cr, const DiskItem& item) {
  add_circle(cr, item.centre, item.radius);
  fill_and_stroke(cr, item.fill, item.stroke);
}

}  // namespace piblocks
