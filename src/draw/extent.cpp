#include "draw/extent.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace piblocks {
namespace {

// Reach of the embedded fonts, in ems, with room to spare: marks above capitals, tails below the
// baseline, and glyphs beyond their advances.
constexpr double kAscent = 1.1;
constexpr double kDescent = 0.35;
constexpr double kOverhang = 0.22;

/// How far a centred line reaches beyond the outline it is drawn on.
double reach_of(const std::optional<Stroke>& stroke) { return stroke ? stroke->width_px / 2 : 0; }

struct ExtentOf {
  const MeasureText& width_em;

  Rect operator()(const TextItem& text) const {
    return extent_of(text, 0, width_em(text.face, text.text));
  }
  Rect operator()(const PathItem& path) const {
    return path.points.bounds().grown(reach_of(path.stroke));
  }
  Rect operator()(const DiscItem& disc) const {
    return Rect{disc.centre.x, disc.centre.y}.grown(reach_of(disc) + kDiscStep_px / 2);
  }
  Rect operator()(const ExposedBlocksItem& item) const {
    return extent_of(item.behind) | extent_of(item.front);
  }
  Rect operator()(const MovingShapesItem& item) const {
    Rect extent = extent_of(item.shapes.front());
    for (const MovingShape& moving : item.shapes) extent = extent | extent_of(moving);
    return extent;
  }
  /// The line of a rectangle is inside its bounds.
  Rect operator()(const auto& item) const { return item.bounds; }
};

struct IsFinite {
  bool operator()(const Rect& r) const {
    return std::isfinite(r.right()) && std::isfinite(r.bottom());
  }
  /// The bounds of a path leave out what is not a number.
  bool operator()(const PathItem& path) const {
    return std::ranges::all_of(path.points.view(), [&](const Point& point) {
      return (*this)(Rect{point.x, point.y});
    });
  }
  bool operator()(const GroupItem& group) const {
    return (*this)(group.bounds) && are_finite(group.list->items);
  }
  bool operator()(const ExposedBlocksItem& item) const {
    return (*this)(extent_of(item.behind)) && (*this)(extent_of(item.front));
  }
  bool operator()(const MovingShapesItem& item) const {
    return std::ranges::all_of(item.shapes,
                               [&](const MovingShape& one) { return (*this)(extent_of(one)); });
  }
  bool operator()(const auto& item) const {
    return (*this)(ExtentOf{[](Face /*face*/, std::string_view /*text*/) { return 0; }}(item));
  }
};

/// Whether a straight line has a point in the extent: whether it enters all of its sides'
/// half-planes before it leaves any.
bool crosses(const Point& from, const Point& to, const Rect& extent) {
  double enters = 0;
  double leaves = 1;
  const auto clip = [&](double at, double step, double low, double high) {
    if (step == 0) return low <= at && at <= high;
    const auto [first, last] = std::minmax({(low - at) / step, (high - at) / step});
    enters = std::max(enters, first);
    leaves = std::min(leaves, last);
    return enters <= leaves;
  };
  return clip(from.x, to.x - from.x, extent.x, extent.right()) &&
         clip(from.y, to.y - from.y, extent.y, extent.bottom());
}

/// Whether there are so few lines that each is looked at by itself, painted where they are.
bool is_few_lines(const PathItem& path) {
  const std::size_t points = path.points.view().size();
  const Rect& r = path.points.bounds();
  const double reach_px =
      std::max({std::abs(r.x), std::abs(r.y), std::abs(r.right()), std::abs(r.bottom())});
  return !path.fill && !path.closed && points > 1 && points <= 16 && reach_px <= kFar_px;
}

/// False only if the path has certainly no point in the extent.
bool may_cross(const PathItem& path, const Rect& extent) {
  const std::span<const Point> points = path.points.view();
  if (!is_few_lines(path)) return true;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (crosses(points[i - 1], points[i], extent)) return true;
  }
  return false;
}

}  // namespace

double reach_of(const DiscItem& disc) { return disc.radius + reach_of(disc.stroke); }

Rect extent_of(const ExposedBlock& block) {
  Rect extent = block.bounds;
  if (block.is_still()) return extent;
  extent.x = block.dwells.front().x;
  extent.width += block.dwells.back().x - block.dwells.front().x;
  return extent;
}

Rect extent_of(const MovingShape& moving) {
  // A small disc is painted wider than it is.
  constexpr double kSmall_px = 1;
  const Rect& places = moving.places.bounds();
  if (const auto* disc = std::get_if<DiscItem>(&moving.shape)) {
    return places.grown(reach_of(*disc) + kSmall_px);
  }
  const Rect& bounds = std::get<ExposedBlock>(moving.shape).bounds;
  return {places.x, bounds.y, places.width + bounds.width, bounds.height};
}

Rect extent_of(const TextItem& text, double left_em, double right_em) {
  const double em = text.size_px;
  return {text.origin.x + (left_em - kOverhang) * em, text.origin.y - kAscent * em,
          (right_em - left_em + 2 * kOverhang) * em, (kAscent + kDescent) * em};
}

Rect extent_of(const DrawItem& item, const MeasureText& width_em) {
  return std::visit(ExtentOf{width_em}, item);
}

std::vector<Rect> extents_of(const PathItem& path) {
  constexpr double kPiece_px = 64;
  constexpr double kMaxPieces = 256;
  const std::span<const Point> points = path.points.view();
  std::vector<Rect> extents;
  if (!is_few_lines(path)) {
    extents.push_back(path.points.bounds().grown(reach_of(path.stroke)));
    return extents;
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point& from = points[i - 1];
    const Point step = points[i] - from;
    const double slant_px = std::min(std::abs(step.x), std::abs(step.y));
    const double pieces = std::ceil(std::clamp(slant_px / kPiece_px, 1.0, kMaxPieces));
    for (double piece = 0; piece < pieces; ++piece) {
      const Point end = from + (piece + 1) / pieces * step;
      extents.push_back(
          Rect::around(from + piece / pieces * step, end).grown(reach_of(path.stroke)));
    }
  }
  return extents;
}

PixelRect pixels_of(const Rect& extent, const PixelRect& area) {
  const auto pixel = [](double at, int begin, int length) {
    return static_cast<int>(std::min(std::max(double(begin), at), double(begin + length)));
  };
  const int x = pixel(std::floor(extent.x), area.x_px, area.width_px);
  const int y = pixel(std::floor(extent.y), area.y_px, area.height_px);
  return {x, y, pixel(std::ceil(extent.right()), area.x_px, area.width_px) - x,
          pixel(std::ceil(extent.bottom()), area.y_px, area.height_px) - y};
}

PixelRect moving_area(const ExposedBlocksItem& item, const PixelRect& area) {
  int left = area.right_px();
  int right = area.x_px;
  int top = area.bottom_px();
  int bottom = area.y_px;
  for (const ExposedBlock* block : {&item.behind, &item.front}) {
    const PixelRect pixels = pixels_of(extent_of(*block), area);
    // Where one block moves, the others are painted with it.
    top = std::min(top, pixels.y_px);
    bottom = std::max(bottom, pixels.bottom_px());
    if (block->is_still() || pixels.width_px <= 0) continue;
    left = std::min(left, pixels.x_px);
    right = std::max(right, pixels.right_px());
  }
  return {left, top, std::max(0, right - left), bottom - top};
}

bool reaches(const DrawItem& item, const PixelRect& rect) {
  // A line of text is taken as endless rather than measured.
  static const MeasureText endless_em = [](Face /*face*/, std::string_view /*text*/) {
    return 1e6;
  };
  const bool may_reach = extent_of(item, endless_em).grown(kRounding_px).meets(to_rect(rect));
  const auto* path = std::get_if<PathItem>(&item);
  if (!may_reach || path == nullptr) return may_reach;
  return may_cross(*path, to_rect(rect).grown(reach_of(path->stroke) + 1));
}

bool are_finite(std::span<const DrawItem> items) {
  return std::ranges::all_of(items,
                             [](const DrawItem& item) { return std::visit(IsFinite(), item); });
}

}  // namespace piblocks
