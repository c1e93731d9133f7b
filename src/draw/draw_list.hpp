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

namespace piblocks {

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

/// From the frame's upper left corner, y down. Whole numbers are the lines between pixels.
struct Point {
  double x = 0;
  double y = 0;
  bool operator==(const Point&) const = default;
};

/// From its upper left corner.
struct Rectangle {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
  bool operator==(const Rectangle&) const = default;
};

inline Rectangle to_rectangle(const PixelRect& r) {
  return {double(r.x_px), double(r.y_px), double(r.width_px), double(r.height_px)};
}

/// A line. On a rectangle it is drawn inside the outline, so that the shape is exactly as large as
/// it says; on a path and on a disk it is centred on the outline.
struct Stroke {
  Color color;
  double width_px = 1;
  /// Length of dashes and of the gaps between them; 0 for a solid line, as that of every disk.
  double dash_px = 0;
  bool operator==(const Stroke&) const = default;
};

struct RectangleItem {
  ItemId id = ItemId::wall;
  Rectangle bounds;
  std::optional<Color> fill;
  std::optional<Stroke> stroke;
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
  const Rectangle& bounds() const noexcept { return bounds_; }
  friend bool operator==(const Points& a, const Points& b) {
    return a.points_ == b.points_ || std::ranges::equal(a.view(), b.view());
  }

 private:
  static Rectangle bounds_of(std::span<const Point> points) {
    if (points.empty()) return {};
    const auto [left, right] = std::ranges::minmax(points, {}, &Point::x);
    const auto [top, bottom] = std::ranges::minmax(points, {}, &Point::y);
    return {left.x, top.y, right.x - left.x, bottom.y - top.y};
  }

  Rectangle bounds_;
  std::shared_ptr<const std::vector<Point>> points_;
};

/// Straight lines from point to point, with round joints.
struct PathItem {
  ItemId id = ItemId::wall;
  Points points;
  bool closed = false;
  std::optional<Color> fill;  ///< of the closed path, by the non-zero rule
  std::optional<Stroke> stroke;
  bool operator==(const PathItem&) const = default;
};

struct DiskItem {
  ItemId id = ItemId::wall;
  Point centre;
  double radius = 0;
  std::optional<Color> fill;
  std::optional<Stroke> stroke;
  bool operator==(const DiskItem&) const = default;
};

/// An image, scaled to its bounds. Equal if the image is the same object.
struct ImageItem {
  ItemId id = ItemId::wall;
  Rectangle bounds;
  std::shared_ptr<const Image> image;  ///< straight alpha
  bool operator==(const ImageItem&) const = default;
};

struct Plate;

/// Items that never change, painted once and kept as pixels. Equal if the plate is the same object.
/// All items with the same plate have bounds of one size, and at one place from the origin.
struct PlateItem {
  ItemId id = ItemId::wall;
  Rectangle bounds;  ///< in whole pixels; the plate is cut off at them
  std::shared_ptr<const Plate> plate;
  Point origin{};  ///< of the plate's items, in whole pixels
  bool operator==(const PlateItem&) const = default;
};

struct DrawList;

/// A picture of its own within the picture, scaled to its bounds and cut off at them. At opacity 1
/// it hides everything behind it, even where its own background is transparent.
struct GroupItem {
  ItemId id = ItemId::compared;
  Rectangle bounds;  ///< of the list's shape
  std::shared_ptr<const DrawList> list;
  double opacity = 1;  ///< 0 … 1

  friend bool operator==(const GroupItem& a, const GroupItem& b);
};

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
  Rectangle bounds;  ///< at the picture's instant
  Color fill;
  Stroke stroke;          ///< solid
  std::vector<Bar> bars;  ///< in the stroke's colour, inside the bounds
  /// From left to right; none if the block stays. Shares add up to 1 less those outside the frame.
  std::vector<Dwell> dwells;
  bool operator==(const ExposedBlock&) const = default;
};

/// A share of an exposure during which the left edge of the block behind and the right edge of the
/// one in front are less than a pixel apart. Both places are left edges.
struct Contact {
  double behind_x = 0;
  double front_x = 0;
  double share = 0;
  bool operator==(const Contact&) const = default;
};

/// Two blocks, exposed: the mean, in linear light, of the pictures that rectangles would make at
/// each instant. A vector file has moving blocks as pixels, and others as rectangles.
struct ExposedItem {
  ItemId id = ItemId::red_block;
  ExposedBlock behind;  ///< on the right
  ExposedBlock front;
  std::vector<Contact> contacts;  ///< from left to right
  bool operator==(const ExposedItem&) const = default;
};

using DrawItem = std::variant<RectangleItem, TextItem, PathItem, DiskItem, ImageItem, PlateItem,
                              GroupItem, ExposedItem>;

struct Plate {
  std::vector<DrawItem> items;  ///< from back to front; none that is exposed
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
  const Rectangle& r = group.bounds;
  return r.width == group.list->width_px && r.x == std::floor(r.x) && r.y == std::floor(r.y);
}

inline bool operator==(const GroupItem& a, const GroupItem& b) {
  return a.id == b.id && a.bounds == b.bounds && a.opacity == b.opacity &&
         (a.list == b.list || *a.list == *b.list);
}

}  // namespace piblocks
