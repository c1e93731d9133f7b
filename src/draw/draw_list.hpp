// One frame as plain data: what is where, in pixels, from back to front.
// In: composition. Out: what the canvas paints and what two frames are compared by.
#pragma once

#include <piblocks/image.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "draw/item_parts.hpp"

namespace piblocks {

struct RectangleItem {
  ItemId id = ItemId::wall;
  Rect bounds;
  std::optional<Color> fill;
  std::optional<Stroke> stroke = {};
  /// Radius of the corners; hardly more than the width of the stroke, which is solid then.
  double corner_px = 0;
  bool operator==(const RectangleItem&) const = default;
};

/// The embedded typefaces.
enum class Face : std::uint8_t {
  article,  ///< DejaVu Sans, of the article's picture; it has the most characters
  text,     ///< Lato Medium
  digits,   ///< Lato Semibold, whose figures are equally wide
  math      ///< Latin Modern Math
};
inline constexpr std::size_t kFaces = 4;

/// One line of text, set from the left end of its baseline.
struct TextItem {
  ItemId id = ItemId::label;
  Point origin;
  std::string text;     ///< UTF-8
  double size_px = 16;  ///< of the em
  Color color;
  Face face = Face::article;  ///< characters that it lacks are set in Face::article
  bool operator==(const TextItem&) const = default;
};

/// Points, shared by all frames in which they are the same.
class Points {
 public:
  Points() = default;
  Points(std::vector<Point> points)
      : bounds_(bounds_of(points)),
        points_(std::make_shared<const std::vector<Point>>(std::move(points))) {}

  std::span<const Point> view() const noexcept {
    return points_ ? std::span<const Point>(*points_) : std::span<const Point>();
  }
  /// The least rectangle around them.
  const Rect& bounds() const noexcept { return bounds_; }
  friend bool operator==(const Points& a, const Points& b) {
    return a.points_ == b.points_ || std::ranges::equal(a.view(), b.view());
  }

 private:
  static Rect bounds_of(std::span<const Point> points) {
    if (points.empty()) return {};
    const auto [left, right] = std::ranges::minmax(points, {}, &Point::x);
    const auto [top, bottom] = std::ranges::minmax(points, {}, &Point::y);
    return {left.x, top.y, right.x - left.x, bottom.y - top.y};
  }

  Rect bounds_;
  std::shared_ptr<const std::vector<Point>> points_;
};

/// Straight lines from point to point, with round joints.
struct PathItem {
  ItemId id = ItemId::wall;
  Points points;
  bool closed = false;
  std::optional<Color> fill;  ///< of the closed path, by the non-zero rule
  std::optional<Stroke> stroke = {};
  bool operator==(const PathItem&) const = default;
};

inline PathItem line_item(ItemId id, std::vector<Point> points, const Stroke& stroke) {
  return {id, std::move(points), false, std::nullopt, stroke};
}

struct DiscItem {
  ItemId id = ItemId::wall;
  Point centre;
  double radius = 0;
  std::optional<Color> fill;
  std::optional<Stroke> stroke = {};
  bool operator==(const DiscItem&) const = default;
};

/// A light that is strongest at its centre and fades to nothing at its radius.
struct GlowItem {
  ItemId id = ItemId::hits;
  Rect bounds;  ///< in whole pixels; the glow is cut off at them
  Point centre;
  double radius = 0;
  Color color;  ///< at the centre

  /// How much of the color is left at a distance from the centre, in radii.
  static constexpr double strength(double distance) {
    const double inside = distance < 1 ? 1 - distance * distance : 0;
    return inside * inside;
  }
  bool operator==(const GlowItem&) const = default;
};

/// What moves less is taken to stay. Far below what a pixel shows, far above roundings.
inline constexpr double kStill_px = 1e-6;

/// A place of a block's left edge, and for which share of the exposure it is there.
struct Dwell {
  double x = 0;
  double share = 0;
  bool operator==(const Dwell&) const = default;
};

/// Rows across a block.
struct Bar {
  double y = 0;
  double height = 0;
  bool operator==(const Bar&) const = default;
};

/// A filled rectangle that moves sideways while the picture is exposed.
struct ExposedBlock {
  Rect bounds;  ///< at the picture's instant
  Color fill;
  Stroke stroke;               ///< solid
  double corner_px = 0;        ///< as of a rectangle
  std::vector<Bar> bars = {};  ///< in the stroke's colour, inside the bounds
  /// From left to right; none if it stays. Shares add up to 1 less those outside the frame.
  std::vector<Dwell> dwells = {};

  bool is_still() const { return dwells.empty(); }
  bool operator==(const ExposedBlock&) const = default;
};

/// A share of an exposure during which two blocks are less than a pixel apart. Both places are left
/// edges.
struct TouchingBlocks {
  double behind_x = 0;
  double front_x = 0;
  double share = 0;
  /// In the pixel of this place both have an edge.
  double right_x() const { return std::max(behind_x, front_x); }
  bool operator==(const TouchingBlocks&) const = default;
};

/// Two blocks, exposed, with the exact time for which each is where: the mean, in linear light, of
/// the pictures that rectangles would make at each instant. A vector file shows the instant.
struct ExposedBlocksItem {
  ItemId id = ItemId::red_block;
  ExposedBlock behind;  ///< they never overlap, but may share a column of pixels
  ExposedBlock front;
  std::vector<TouchingBlocks> contacts;  ///< in the order of right_x()
  bool operator==(const ExposedBlocksItem&) const = default;
};

/// What moves while a picture is exposed.
struct MovingShape {
  std::variant<ExposedBlock, DiscItem> shape;  ///< at the picture's instant; without dwells
  Points places;  ///< of the block's upper left corner or the disc's centre, at each moment
  bool operator==(const MovingShape&) const = default;
};

/// Any shapes, exposed: the mean, in linear light, of their pictures at some moments. A vector file
/// shows the instant.
struct MovingShapesItem {
  ItemId id = ItemId::red_block;
  std::vector<double> shares;       ///< of the exposure, for which each moment stands
  std::vector<MovingShape> shapes;  ///< from back to front, with a place for each moment; they
                                    ///< never overlap
  bool operator==(const MovingShapesItem&) const = default;
};

/// An image, scaled to its bounds. Equal if the image is the same object.
struct ImageItem {
  ItemId id = ItemId::wall;
  Rect bounds;
  std::shared_ptr<const Image> image;  ///< straight alpha
  bool operator==(const ImageItem&) const = default;
};

struct Plate;

/// Items that never change, painted once and kept as pixels.
/// All items with the same plate have bounds of one size, and at one place from the origin.
struct PlateItem {
  ItemId id = ItemId::wall;
  Rect bounds;  ///< in whole pixels; the plate is cut off at them
  std::shared_ptr<const Plate> plate;
  Point origin{};  ///< of the plate's items, in whole pixels

  friend bool operator==(const PlateItem& a, const PlateItem& b);
};

struct DrawList;

/// A picture of its own within the picture, scaled to its bounds and cut off at them. At opacity 1
/// it hides everything behind it, even where its own background is transparent.
struct GroupItem {
  ItemId id = ItemId::compared;
  Rect bounds;  ///< of the list's shape
  std::shared_ptr<const DrawList> list;
  double opacity = 1;  ///< 0 … 1

  friend bool operator==(const GroupItem& a, const GroupItem& b);
};

using DrawItem = std::variant<RectangleItem, TextItem, PathItem, DiscItem, GlowItem, ImageItem,
                              PlateItem, GroupItem, ExposedBlocksItem, MovingShapesItem>;

struct Plate {
  std::vector<DrawItem> items;  ///< from back to front; none that is exposed
  bool operator==(const Plate&) const = default;
};

struct DrawList {
  int width_px = 0;
  int height_px = 0;
  std::optional<Color> background = Color{255, 255, 255};  ///< transparent if empty
  std::vector<DrawItem> items;                             ///< from back to front
  bool operator==(const DrawList&) const = default;
};

/// Adds a block that stays: a rectangle for it, and one for each of its bars.
void add_rectangles(ItemId id, const ExposedBlock& block, std::vector<DrawItem>& items);

/// Whether a pixel of the group's list is a pixel of the picture.
inline bool is_on_pixels(const GroupItem& group) {
  const Rect& r = group.bounds;
  return r.width == group.list->width_px && r.x == std::floor(r.x) && r.y == std::floor(r.y);
}

/// Two runs may have plates of the same items.
inline bool operator==(const PlateItem& a, const PlateItem& b) {
  return a.id == b.id && a.bounds == b.bounds && a.origin == b.origin &&
         (a.plate == b.plate || (a.plate && b.plate && *a.plate == *b.plate));
}

inline bool operator==(const GroupItem& a, const GroupItem& b) {
  return a.id == b.id && a.bounds == b.bounds && a.opacity == b.opacity &&
         (a.list == b.list || *a.list == *b.list);
}

}  // namespace piblocks
