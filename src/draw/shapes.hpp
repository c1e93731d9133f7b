// What draw items are made of: colours, places and lines.
// In: composition. Out: parts of a draw list.
// All lengths are in pixels.
#pragma once

#include <cstdint>

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

}  // namespace piblocks
