#include "draw/extent.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
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

/// Around both.
Extent around(const Extent& a, const Extent& b) {
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

/// Beyond its centre.
double reach_of(const DiscItem& disc) { return disc.radius + reach_of(disc.stroke); }

struct ExtentOf {
  const MeasureText& width_em;

  Extent operator()(const TextItem& text) const {
    return extent_of(text, 0, width_em(text.face, text.text));
  }
  Extent operator()(const PathItem& path) const {
    return extent_of(path.points.bounds()).grown(reach_of(path.stroke));
  }
  Extent operator()(const DiscItem& disc) const {
    return Extent{disc.centre.x, disc.centre.y, disc.centre.x, disc.centre.y}.grown(
        reach_of(disc) + kDiscStep_px / 2);
  }
  Extent operator()(const ExposedBlocksItem& item) const {
    return around(extent_of(item.behind), extent_of(item.front));
  }
  Extent operator()(const MovingShapesItem& item) const { return extent_of(item); }
  /// The line of a rectangle is inside its bounds.
  Extent operator()(const auto& item) const { return extent_of(item.bounds); }
};

/// Whether a straight line has a point in the extent: whether it enters all of its sides'
/// half-planes before it leaves any.
bool crosses(const Point& from, const Point& to, const Extent& extent) {
  double enters = 0;
  double leaves = 1;
  const auto clip = [&](double at, double step, double low, double high) {
    if (step == 0) return low <= at && at <= high;
    const auto [first, last] = std::minmax({(low - at) / step, (high - at) / step});
    enters = std::max(enters, first);
    leaves = std::min(leaves, last);
    return enters <= leaves;
  };
  return clip(from.x, to.x - from.x, extent.left, extent.right) &&
         clip(from.y, to.y - from.y, extent.top, extent.bottom);
}

/// Whether there are so few lines that each is looked at by itself, painted where they are.
bool is_few_lines(const PathItem& path) {
  const std::size_t points = path.points.view().size();
  const Rectangle& r = path.points.bounds();
  const double reach_px =
      std::max({std::abs(r.x), std::abs(r.y), std::abs(r.x + r.width), std::abs(r.y + r.height)});
  return !path.fill && !path.closed && points > 1 && points <= 16 && reach_px <= kFar_px;
}

/// False only if the path has certainly no point in the extent.
bool may_cross(const PathItem& path, const Extent& extent) {
  const std::span<const Point> points = path.points.view();
  if (!is_few_lines(path)) return true;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (crosses(points[i - 1], points[i], extent)) return true;
  }
  return false;
}

}  // namespace

Extent extent_of(const Rectangle& r) { return {r.x, r.y, r.x + r.width, r.y + r.height}; }

Extent extent_of(const ExposedBlock& block) {
  Extent extent = extent_of(block.bounds);
  if (!block.dwells.empty()) {
    extent.left = block.dwells.front().x;
    extent.right = block.dwells.back().x + block.bounds.width;
  }
  return extent;
}

Extent extent_of(const MovingShape& moving) {
  // A small disc is painted wider than it is.
  constexpr double kSmall_px = 1;
  const Extent places = extent_of(moving.places.bounds());
  if (const auto* disc = std::get_if<DiscItem>(&moving.shape)) {
    return places.grown(reach_of(*disc) + kSmall_px);
  }
  const Rectangle& bounds = std::get<ExposedBlock>(moving.shape).bounds;
  return {places.left, bounds.y, places.right + bounds.width, bounds.y + bounds.height};
}

Extent extent_of(const MovingShapesItem& item) {
  Extent extent = extent_of(item.shapes.front());
  for (const MovingShape& moving : item.shapes) extent = around(extent, extent_of(moving));
  return extent;
}

Extent extent_of(const TextItem& text, double left_em, double right_em) {
  const double em = text.size_px;
  return {text.origin.x + (left_em - kOverhang) * em, text.origin.y - kAscent * em,
          text.origin.x + (right_em + kOverhang) * em, text.origin.y + kDescent * em};
}

Extent extent_of(const DrawItem& item, const MeasureText& width_em) {
  return std::visit(ExtentOf{width_em}, item);
}

std::vector<Extent> extents_of(const PathItem& path) {
  constexpr double kPiece_px = 64;
  constexpr double kMaxPieces = 256;
  const std::span<const Point> points = path.points.view();
  std::vector<Extent> extents;
  if (!is_few_lines(path)) {
    extents.push_back(extent_of(path.points.bounds()).grown(reach_of(path.stroke)));
    return extents;
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point& from = points[i - 1];
    const Point step{points[i].x - from.x, points[i].y - from.y};
    const double slant_px = std::min(std::abs(step.x), std::abs(step.y));
    const double pieces = std::ceil(std::clamp(slant_px / kPiece_px, 1.0, kMaxPieces));
    for (double piece = 0; piece < pieces; ++piece) {
      const auto [left, right] =
          std::minmax({from.x + piece / pieces * step.x, from.x + (piece + 1) / pieces * step.x});
      const auto [top, bottom] =
          std::minmax({from.y + piece / pieces * step.y, from.y + (piece + 1) / pieces * step.y});
      extents.push_back(Extent{left, top, right, bottom}.grown(reach_of(path.stroke)));
    }
  }
  return extents;
}

PixelRect pixels_of(const Extent& extent, const PixelRect& area) {
  const auto pixel = [](double at, int begin, int length) {
    return static_cast<int>(std::min(std::max(double(begin), at), double(begin + length)));
  };
  const int x = pixel(std::floor(extent.left), area.x_px, area.width_px);
  const int y = pixel(std::floor(extent.top), area.y_px, area.height_px);
  return {x, y, pixel(std::ceil(extent.right), area.x_px, area.width_px) - x,
          pixel(std::ceil(extent.bottom), area.y_px, area.height_px) - y};
}

PixelRect moving_area(const ExposedBlocksItem& item, const PixelRect& area) {
  int left = area.x_px + area.width_px;
  int right = area.x_px;
  int top = area.y_px + area.height_px;
  int bottom = area.y_px;
  for (const ExposedBlock* block : {&item.behind, &item.front}) {
    const PixelRect pixels = pixels_of(extent_of(*block), area);
    // Where one block moves, the others are painted with it.
    top = std::min(top, pixels.y_px);
    bottom = std::max(bottom, pixels.y_px + pixels.height_px);
    if (block->is_still() || pixels.width_px <= 0) continue;
    left = std::min(left, pixels.x_px);
    right = std::max(right, pixels.x_px + pixels.width_px);
  }
  return {left, top, std::max(0, right - left), bottom - top};
}

PixelRect moving_area(const MovingShapesItem& item, const PixelRect& area) {
  return pixels_of(extent_of(item), area);
}

bool reaches(const DrawItem& item, const PixelRect& rect) {
  // A line of text is taken as endless rather than measured.
  static const MeasureText endless_em = [](Face /*face*/, std::string_view /*text*/) {
    return 1e6;
  };
  const Extent extent = extent_of(item, endless_em).grown(kRounding_px);
  const bool may_reach = extent.left < rect.x_px + rect.width_px && extent.right > rect.x_px &&
                         extent.top < rect.y_px + rect.height_px && extent.bottom > rect.y_px;
  const auto* path = std::get_if<PathItem>(&item);
  if (!may_reach || path == nullptr) return may_reach;
  return may_cross(*path, extent_of(to_rectangle(rect)).grown(reach_of(path->stroke) + 1));
}

bool are_finite(std::span<const DrawItem> items) {
  const auto is_finite = [](std::initializer_list<double> numbers) {
    return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
  };
  static const MeasureText no_width = [](Face /*face*/, std::string_view /*text*/) { return 0; };
  return std::ranges::all_of(items, [&](const DrawItem& item) {
    // The bounds of a path leave out what is not a number.
    if (const auto* path = std::get_if<PathItem>(&item)) {
      return std::ranges::all_of(path->points.view(), [&](const Point& point) {
        return is_finite({point.x, point.y});
      });
    }
    const auto* group = std::get_if<GroupItem>(&item);
    if (group != nullptr && !are_finite(group->list->items)) return false;
    const auto [left, top, right, bottom] = extent_of(item, no_width);
    return is_finite({left, top, right, bottom});
  });
}

}  // namespace piblocks
