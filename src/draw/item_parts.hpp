// What draw items are made of: points, rectangles and circles, ids, colours, lines.
// In: composition. Out: parts of items.
#pragma once

#include <piblocks/image.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/rounded.hpp"

namespace piblocks {

/// From the frame's upper left corner, y down. Whole numbers are the lines between pixels. Also the
/// way from one place to another.
struct Point {
  double x = 0;
  double y = 0;
  bool operator==(const Point&) const = default;

  friend constexpr Point operator+(const Point& a, const Point& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend constexpr Point operator-(const Point& a, const Point& b) {
    return {a.x - b.x, a.y - b.y};
  }
  friend constexpr Point operator*(double factor, const Point& a) {
    return {factor * a.x, factor * a.y};
  }
  friend constexpr Point operator/(const Point& a, double divisor) {
    return {a.x / divisor, a.y / divisor};
  }
};

constexpr double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
/// Above 0 if `b` is to the right of `a`, as seen in a picture.
constexpr double cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
/// Of a way within the range of a picture; rounded::hypot() is for any numbers.
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }
/// A quarter turn to the right, as seen in a picture.
constexpr Point turned_right(const Point& a) { return {-a.y, a.x}; }
/// So much of the way from one point to another.
constexpr Point on_way(const Point& from, const Point& to, double share) {
  return from + share * (to - from);
}

/// Cairo's coordinates wrap around at 2^23 pixels. Paths are painted as if they ended here; no
/// frame and no line reaches as far.
inline constexpr double kFar_px = 1 << 22;

/// From its upper left corner. Four edges would round the width of a rectangle that moves.
struct Rect {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
  bool operator==(const Rect&) const = default;

  constexpr double right() const { return x + width; }
  constexpr double bottom() const { return y + height; }
  constexpr Point centre() const { return {x + width / 2, y + height / 2}; }
  /// From the upper left one, clockwise.
  std::vector<Point> corners() const {
    return {{x, y}, {right(), y}, {right(), bottom()}, {x, bottom()}};
  }

  /// The least one around both points, cut off at kFar_px: a great length would round the edge that
  /// is near.
  static Rect around(const Point& a, const Point& b) {
    const auto cut = [](double px) { return std::clamp(px, -kFar_px, kFar_px); };
    const auto [left, right] = std::minmax({cut(a.x), cut(b.x)});
    const auto [top, bottom] = std::minmax({cut(a.y), cut(b.y)});
    return {left, top, right - left, bottom - top};
  }
  /// The least one around both, cut off as that.
  friend Rect operator|(const Rect& a, const Rect& b) {
    return around({std::min(a.x, b.x), std::min(a.y, b.y)},
                  {std::max(a.right(), b.right()), std::max(a.bottom(), b.bottom())});
  }
  friend constexpr Rect operator+(const Rect& a, const Point& way) {
    return {a.x + way.x, a.y + way.y, a.width, a.height};
  }
  /// Larger on the left and the right, and above and below.
  constexpr Rect grown(double across, double down) const {
    return {x - across, y - down, width + 2 * across, height + 2 * down};
  }
  constexpr Rect grown(double px) const { return grown(px, px); }
  /// The whole pixels that it reaches into.
  Rect whole_pixels() const {
    const double left = std::floor(x);
    const double top = std::floor(y);
    return {left, top, std::ceil(right()) - left, std::ceil(bottom()) - top};
  }
  /// Whether they share more than an edge.
  constexpr bool meets(const Rect& other) const {
    return x < other.right() && other.x < right() && y < other.bottom() && other.y < bottom();
  }
  constexpr bool holds(const Rect& inner) const {
    return x <= inner.x && inner.right() <= right() && y <= inner.y && inner.bottom() <= bottom();
  }
};

struct Circle {
  Point centre;
  double radius = 0;
  /// @param angle  counter-clockwise, from the right
  Point at(double angle) const {
    const auto [sine, cosine] = rounded::sin_cos(angle);
    return {centre.x + radius * cosine, centre.y - radius * sine};
  }
  /// steps + 1 points.
  std::vector<Point> arc(double from, double to, int steps) const {
    std::vector<Point> points;
    for (int i = 0; i <= steps; ++i) points.push_back(at(from + (to - from) * i / steps));
    return points;
  }
  /// Points whose connecting lines are within 0.03 % of the radius.
  std::vector<Point> arc(double from, double to) const {
    constexpr double kStep = 0.05;  // radians
    return arc(from, to, std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / kStep))));
  }
};

/// How far a round corner is inside the side of its rectangle; 0 where nobody would see it.
/// @param from_end  of the place on the side, from the nearer end
inline double corner_inset(double radius, double from_end) {
  const double left = radius - std::max(0.0, from_end);
  const double inset = left > 0 ? radius - std::sqrt(radius * radius - left * left) : 0;
  return inset > 0.125 ? inset : 0;
}

inline Rect to_rect(const PixelRect& r) {
  return {double(r.x_px), double(r.y_px), double(r.width_px), double(r.height_px)};
}

/// The first of 65,536 ids for what shows one thing.
constexpr std::uint32_t ids_from(std::uint32_t thing) { return thing << 16; }

/// What an item shows, the same from frame to frame. Where several items show one thing, nth()
/// tells them apart. Where ids rise from back to front, a frame may have more or fewer items than
/// the one before, and only these are painted.
enum class ItemId : std::uint32_t {
  wall = ids_from(0),
  red_block = ids_from(1),
  blue_block = ids_from(2),
  label = ids_from(3),
  lit_count = ids_from(4),
  count = ids_from(5),
  pi = ids_from(6),
  masses = ids_from(7),
  velocities = ids_from(8),
  hits = ids_from(9),
  ruler = ids_from(10),
  read_outs = ids_from(11),
  loupe = ids_from(12),
  title = ids_from(13),
  caption = ids_from(14),
  logo = ids_from(15),
  panels = ids_from(16),  ///< and one for each panel after it
  card = ids_from(100),
  compared = ids_from(101),
  fade = ids_from(102)
};

/// The n-th of the items that show one thing, n < 65,536.
constexpr ItemId nth(ItemId thing, std::size_t n) {
  return ItemId{static_cast<std::uint32_t>(thing) + static_cast<std::uint32_t>(n)};
}

/// sRGB, with straight alpha.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t alpha = 255;  ///< 255 is opaque
  bool operator==(const Color&) const = default;
};

/// A line. On a rectangle it is drawn inside the outline, so that the shape is exactly as large as
/// it says; on a path and on a disc it is centred on the outline.
struct Stroke {
  Color color;
  double width_px = 1;
  /// Length of dashes and of the gaps between them; 0 for a solid line, as that of every disc.
  double dash_px = 0;
  bool operator==(const Stroke&) const = default;
};

}  // namespace piblocks
