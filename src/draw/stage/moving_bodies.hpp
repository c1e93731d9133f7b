// Bodies while a picture is exposed.
// In: how they look at its instant, and where they are while it is exposed. Out: items.
#pragma once

#include <piblocks/image.hpp>

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

/// A body at the picture's instant. @see MovingShape
struct PlacedBody {
  ItemId id;
  std::size_t body = 0;  ///< its number
  std::variant<ExposedBlock, DiscItem> still;
};

/// Adds the bodies that stay, and one item of all others.
/// @param bodies     in the order in which they are painted
/// @param exposures  none if the picture is that of its instant
void add_exposed(std::span<const PlacedBody> bodies, const Layout& map, const PixelRect& frame,
                 std::span<const WeightedExposure> exposures, std::vector<DrawItem>& items);

}  // namespace piblocks
