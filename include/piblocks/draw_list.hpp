// One frame as plain data: what is where, in pixels, from back to front.
// In: composition. Out: what the canvas paints and what two frames are compared by.
#pragma once

#include <piblocks/image.hpp>

#include <algorithm>
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

/// Opaque sRGB colour.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Color&, const Color&) = default;
};

/// In pixels, y downwards, origin at the frame's upper left corner; whole numbers are the lines
/// between pixels.
struct Point {
  double x = 0;
  double y = 0;

  friend bool operator==(const Point&, const Point&) = default;
};

/// In pixels, from its upper left corner.
struct Rectangle {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;

  friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

/// A line. On a rectangle it is drawn inside the outline, so that the shape is exactly as large as
/// it says; on a path and on a disk it is centred on the outline.
struct Stroke {
  Color color;
  double width_px = 1;
  double dash_px = 0;  ///< length of dashes and of the gaps between them; 0 for a solid line

  friend bool operator==(const Stroke&, const Stroke&) = default;
};

/// The first of 65,536 ids for what shows one thing.
constexpr std::uint32_t ids_from(std::uint32_t thing) { return thing << 16; }

/// What an item shows, the same from frame to frame. Where several items show one thing, nth()
/// tells them apart. Lists whose ids rise from back to front may gain and lose items from frame to
/// frame, and only these are painted.
enum class ItemId : std::uint32_t {
  wall = ids_from(0),
  red_block = ids_from(1),
  blue_block = ids_from(2),
  label = ids_from(3),
  lit_count = ids_from(4),
  count = ids_from(5),
  masses = ids_from(6),
  velocities = ids_from(7),
  ruler = ids_from(8),
  read_outs = ids_from(9),
  title = ids_from(10),
  caption = ids_from(11),
  logo = ids_from(12),
  panels = ids_from(13),  ///< and one for each panel after it
  card = ids_from(100),
  compared = ids_from(101),
  fade = ids_from(102)
};

/// The n-th of the items that show one thing, n < 65,536.
constexpr ItemId nth(ItemId thing, std::size_t n) {
  return ItemId{static_cast<std::uint32_t>(thing) + static_cast<std::uint32_t>(n)};
}

struct RectangleItem {
  ItemId id = ItemId::wall;
  Rectangle bounds;
  std::optional<Color> fill;
  std::optional<Stroke> stroke;

  friend bool operator==(const RectangleItem&, const RectangleItem&) = default;
};

/// One line of text, set from the left end of its baseline.
struct TextItem {
  ItemId id = ItemId::label;
  Point origin;
  std::string text;     ///< UTF-8
  double size_px = 16;  ///< of the em
  Color color;

  friend bool operator==(const TextItem&, const TextItem&) = default;
};

/// Points that may be many and are shared by all frames in which they are the same.
class Points {
 public:
  Points() = default;
  Points(std::vector<Point> points)
      : points_(std::make_shared<const std::vector<Point>>(std::move(points))) {}

  std::span<const Point> view() const noexcept {
    return points_ ? std::span<const Point>(*points_) : std::span<const Point>();
  }
  friend bool operator==(const Points& a, const Points& b) {
    return a.points_ == b.points_ || std::ranges::equal(a.view(), b.view());
  }

 private:
  std::shared_ptr<const std::vector<Point>> points_;
};

/// Straight lines from point to point, with round joints.
struct PathItem {
  ItemId id = ItemId::wall;
  Points points;
  bool closed = false;
  std::optional<Color> fill;  ///< of the closed path, by the non-zero rule
  std::optional<Stroke> stroke;

  friend bool operator==(const PathItem&, const PathItem&) = default;
};

struct DiskItem {
  ItemId id = ItemId::wall;
  Point centre;
  double radius = 0;
  std::optional<Color> fill;
  std::optional<Stroke> stroke;

  friend bool operator==(const DiskItem&, const DiskItem&) = default;
};

/// A picture, scaled to its bounds. Equal if it is the same picture in memory.
struct ImageItem {
  ItemId id = ItemId::wall;
  Rectangle bounds;
  std::shared_ptr<const Image> image;  ///< straight alpha

  friend bool operator==(const ImageItem&, const ImageItem&) = default;
};

struct DrawList;

/// A picture of its own within the picture, cut off at its edges.
struct GroupItem {
  ItemId id = ItemId::compared;
  int x_px = 0;  ///< of its upper left corner
  int y_px = 0;
  std::shared_ptr<const DrawList> list;
  double opacity = 1;  ///< 0 … 1

  friend bool operator==(const GroupItem& a, const GroupItem& b);
};

using DrawItem = std::variant<RectangleItem, TextItem, PathItem, DiskItem, ImageItem, GroupItem>;

struct DrawList {
  int width_px = 0;
  int height_px = 0;
  Color background = {255, 255, 255};
  std::vector<DrawItem> items;  ///< from back to front

  friend bool operator==(const DrawList&, const DrawList&) = default;
};

inline bool operator==(const GroupItem& a, const GroupItem& b) {
  return a.id == b.id && a.x_px == b.x_px && a.y_px == b.y_px && a.opacity == b.opacity &&
         (a.list == b.list || *a.list == *b.list);
}

}  // namespace piblocks
