// One frame as plain data: what is where, in pixels, from back to front.
// In: composition. Out: what the canvas paints and what two frames are compared by.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
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

/// A line drawn inside the outline, so that a shape is exactly as large as it says.
struct Stroke {
  Color color;
  double width_px = 1;
  double dash_px = 0;  ///< length of dashes and of the gaps between them; 0 for a solid line

  friend bool operator==(const Stroke&, const Stroke&) = default;
};

/// What an item shows, the same from frame to frame.
enum class ItemId : std::uint8_t { wall, red_block, blue_block, label, count };

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

using DrawItem = std::variant<RectangleItem, TextItem>;

struct DrawList {
  int width_px = 0;
  int height_px = 0;
  std::optional<Color> background = Color{255, 255, 255};  ///< transparent without
  std::vector<DrawItem> items;                             ///< from back to front

  friend bool operator==(const DrawList&, const DrawList&) = default;
};

}  // namespace piblocks
