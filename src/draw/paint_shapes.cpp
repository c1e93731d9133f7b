#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "draw/painter.hpp"

namespace piblocks {
namespace {

/// Dashes along one side, fitted to end in each corner and to look the same from both ends.
void stroke_side(cairo_t& cr, const Point& from, const Point& to, double dash_px) {
  const double side_px = length(to - from);
  const double periods = std::max(1.0, std::round((side_px / dash_px - 1) / 2));
  const double fitted = side_px / (2 * periods + 1);
  cairo_set_dash(&cr, &fitted, 1, 0);
  cairo_move_to(&cr, from.x, from.y);
  cairo_line_to(&cr, to.x, to.y);
  cairo_stroke(&cr);
}

/// The rows of pixels of a rectangle with round corners: one after the other at the corners, and
/// what is between at once. Calls visit(strip), which reaches from side to side.
template <typename Visit>
void each_strip(const Rect& bounds, double corner_px, const Visit& visit) {
  const double top = std::min(std::ceil(bounds.y + corner_px), bounds.bottom());
  const double bottom = std::max(std::floor(bounds.bottom() - corner_px), top);
  for (double y = bounds.y; y < bounds.bottom();) {
    const double next =
        y == top && top < bottom ? bottom : std::min(std::floor(y) + 1, bounds.bottom());
    const double middle = (y + next) / 2;
    const double inset =
        corner_inset(corner_px, std::min(middle - bounds.y, bounds.bottom() - middle));
    visit(Rect{bounds.x + inset, y, bounds.width - 2 * inset, next - y});
    y = next;
  }
}

void fill(cairo_t& cr, const Color& color) {
  set_color(cr, color);
  cairo_fill(&cr);
}

/// The same rows as of a block that moves.
void paint_round_pixels(cairo_t& cr, const RectangleItem& item) {
  const Rect& bounds = item.bounds;
  if (item.fill) {
    each_strip(bounds, item.corner_px, [&](const Rect& strip) { add_rectangle(cr, strip); });
    fill(cr, *item.fill);
  }
  if (!item.stroke) return;
  const double line = std::min({item.stroke->width_px, bounds.width, bounds.height});
  each_strip(bounds, item.corner_px, [&](const Rect& strip) {
    const bool is_inside = bounds.y + line <= strip.y && strip.bottom() <= bounds.bottom() - line;
    const double left = bounds.x + line;
    const double right = bounds.right() - line;
    if (!is_inside || left >= right) return add_rectangle(cr, strip);
    add_rectangle(cr, {strip.x, strip.y, left - strip.x, strip.height});
    add_rectangle(cr, {right, strip.y, strip.right() - right, strip.height});
  });
  fill(cr, item.stroke->color);
}

/// A rectangle with round corners as a path.
void add_round_rectangle(cairo_t& cr, const Rect& bounds, double radius) {
  constexpr double kHandle = 0.5522847498307936;  // 4/3 tan(pi / 8)
  const std::vector<Point> corners = bounds.corners();
  for (std::size_t i = 0; i < 4; ++i) {
    const Point& corner = corners[i];
    const auto towards = [&](const Point& to, double px) {
      return corner + px / length(to - corner) * (to - corner);
    };
    const Point& before = corners[(i + 3) % 4];
    const Point& after = corners[(i + 1) % 4];
    const Point from = towards(before, radius);
    const Point out = towards(before, (1 - kHandle) * radius);
    const Point in = towards(after, (1 - kHandle) * radius);
    const Point to = towards(after, radius);
    cairo_line_to(&cr, from.x, from.y);
    cairo_curve_to(&cr, out.x, out.y, in.x, in.y, to.x, to.y);
  }
  cairo_close_path(&cr);
}

void stroke_inside(cairo_t& cr, const Rect& bounds, const Stroke& stroke) {
  set_color(cr, stroke.color);
  const double width_px = std::min({stroke.width_px, bounds.width, bounds.height});
  if (width_px < stroke.width_px) {
    // A shape thinner than its stroke is nothing but stroke. Cairo paints half of a line around a
    // rectangle of no width, and nothing of one around a point.
    add_rectangle(cr, bounds);
    cairo_fill(&cr);
    return;
  }
  const Rect middle = bounds.grown(-width_px / 2);
  cairo_set_line_width(&cr, width_px);
  if (stroke.dash_px <= 0) {
    cairo_set_dash(&cr, nullptr, 0, 0);
    add_rectangle(cr, middle);
    cairo_stroke(&cr);
    return;
  }
  cairo_set_line_cap(&cr, CAIRO_LINE_CAP_SQUARE);
  const std::vector<Point> corners = middle.corners();
  for (std::size_t i = 0; i < 4; ++i) {
    stroke_side(cr, corners[i], corners[(i + 1) % 4], stroke.dash_px);
  }
  cairo_set_line_cap(&cr, CAIRO_LINE_CAP_BUTT);
}

double within_reach(double px) { return std::clamp(px, -kFar_px, kFar_px); }

Rect within_reach(const Rect& r) {
  const double x = within_reach(r.x);
  const double y = within_reach(r.y);
  if (x == r.x && y == r.y && r.width <= kMaxSide_px && r.height <= kMaxSide_px) return r;
  return {x, y, within_reach(r.right()) - x, within_reach(r.bottom()) - y};
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

void add_path(cairo_t& cr, std::span<const Point> points, bool closed) {
  for (const Point& point : points) cairo_line_to(&cr, point.x, point.y);
  if (closed) cairo_close_path(&cr);
}

/// Without a copy of the points, unless Cairo could not take one of them.
template <typename Use>
void with_points_in_reach(const Points& all, const Use& use) {
  const auto is_in_reach = [](const Point& p) {
    return within_reach(p.x) == p.x && within_reach(p.y) == p.y;
  };
  if (std::ranges::all_of(all.view(), is_in_reach)) return use(all.view());
  std::vector<Point> points(all.view().begin(), all.view().end());
  for (Point& point : points) point = {within_reach(point.x), within_reach(point.y)};
  use(std::span<const Point>(points));
}

/// Eight curves, at most 5e-6 of the radius from the circle. Those of cairo_arc() take sine and
/// cosine from the C library, which are not the same everywhere.
void add_circle_curves(cairo_t& cr, const Point& centre, double radius) {
  constexpr double kHandle = 0.26521648983954400;  // 4/3 tan(pi / 16)
  constexpr double kHalf = std::numbers::sqrt2 / 2;
  constexpr std::array<Point, 9> kDirections{{{1, 0},
                                              {kHalf, kHalf},
                                              {0, 1},
                                              {-kHalf, kHalf},
                                              {-1, 0},
                                              {-kHalf, -kHalf},
                                              {0, -1},
                                              {kHalf, -kHalf},
                                              {1, 0}}};
  const auto at = [&](const Point& direction, double along) {
    return centre + radius * (direction + along * turned_right(direction));
  };
  cairo_move_to(&cr, centre.x + radius, centre.y);
  for (std::size_t i = 1; i < kDirections.size(); ++i) {
    const Point out = at(kDirections.at(i - 1), kHandle);
    const Point in = at(kDirections.at(i), -kHandle);
    const Point to = at(kDirections.at(i), 0);
    cairo_curve_to(&cr, out.x, out.y, in.x, in.y, to.x, to.y);
  }
  cairo_close_path(&cr);
}

}  // namespace

void add_rectangle(cairo_t& cr, const Rect& r) {
  cairo_rectangle(&cr, r.x, r.y, r.width, r.height);
}

void set_color(cairo_t& cr, const Color& color) {
  // An opaque source takes Cairo's faster ways.
  if (color.alpha == 255) {
    cairo_set_source_rgb(&cr, color.red / 255.0, color.green / 255.0, color.blue / 255.0);
  } else {
    cairo_set_source_rgba(&cr, color.red / 255.0, color.green / 255.0, color.blue / 255.0,
                          color.alpha / 255.0);
  }
}

bool has_pixels(cairo_t& cr) {
  return cairo_surface_get_type(cairo_get_target(&cr)) == CAIRO_SURFACE_TYPE_IMAGE;
}

/// With a line inside.
void paint_round(cairo_t& cr, const RectangleItem& item) {
  if (has_pixels(cr)) return paint_round_pixels(cr, item);
  add_round_rectangle(cr, item.bounds, item.corner_px);
  fill_and_stroke(cr, item.fill, std::nullopt);
  if (!item.stroke) return;
  const double half = std::min(item.stroke->width_px / 2, item.corner_px);
  add_round_rectangle(cr, item.bounds.grown(-half), item.corner_px - half);
  fill_and_stroke(cr, std::nullopt, item.stroke);
}

void paint_shape(cairo_t& cr, const RectangleItem& item) {
  const Rect bounds = within_reach(item.bounds);
  const double corner_px = std::min({item.corner_px, bounds.width / 2, bounds.height / 2});
  if (corner_px > 0) return paint_round(cr, {item.id, bounds, item.fill, item.stroke, corner_px});
  if (item.fill) {
    add_rectangle(cr, bounds);
    fill(cr, *item.fill);
  }
  if (item.stroke) stroke_inside(cr, bounds, *item.stroke);
}

void paint_shape(cairo_t& cr, const PathItem& item) {
  with_points_in_reach(item.points, [&](std::span<const Point> points) {
    if (!has_pixels(cr)) {
      add_path(cr, points, item.closed);
      return fill_and_stroke(cr, item.fill, item.stroke);
    }
    if (item.fill) {
      add_path(cr, points, true);
      fill(cr, *item.fill);
    }
    if (item.stroke) {
      add_line_outline(cr, points, item.closed, item.stroke->width_px, item.stroke->dash_px);
      fill(cr, item.stroke->color);
    }
  });
}

void paint_shape(cairo_t& cr, const DiscItem& item) {
  if (!has_pixels(cr)) {
    add_circle_curves(cr, item.centre, item.radius);
    return fill_and_stroke(cr, item.fill, item.stroke);
  }
  if (item.fill) {
    add_circle(cr, item.centre, item.radius);
    fill(cr, *item.fill);
  }
  if (item.stroke) {
    const double half_px = item.stroke->width_px / 2;
    add_circle(cr, item.centre, item.radius + half_px);
    if (item.radius > half_px) {
      add_circle(cr, item.centre, item.radius - half_px, Winding::counterclockwise);
    }
    fill(cr, item.stroke->color);
  }
}

void paint_shape(cairo_t& cr, const GlowItem& item) {
  constexpr int kStops = 8;
  const auto& [x, y] = item.centre;
  const CairoPatternPtr light(cairo_pattern_create_radial(x, y, 0, x, y, item.radius));
  const Color& color = item.color;
  for (int stop = 0; stop <= kStops; ++stop) {
    const double distance = double(stop) / kStops;
    cairo_pattern_add_color_stop_rgba(light.get(), distance, color.red / 255.0, color.green / 255.0,
                                      color.blue / 255.0,
                                      color.alpha / 255.0 * GlowItem::strength(distance));
  }
  cairo_set_source(&cr, light.get());
  add_rectangle(cr, item.bounds);
  cairo_fill(&cr);
}

}  // namespace piblocks
