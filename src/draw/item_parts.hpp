// What draw items are made of beside places: ids, colours, lines.
// In: composition. Out: parts of items.
#pragma once

#include <cstddef>
#include <cstdint>

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
