// What the items of draw lists show, so that frames can be compared item by item.
// In: a thing that is drawn. Out: its id, the same in every frame.
#pragma once

#include <cstddef>
#include <cstdint>

namespace piblocks {

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

}  // namespace piblocks
