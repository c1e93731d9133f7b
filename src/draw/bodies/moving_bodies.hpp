// Bodies while a picture is exposed.
// In: how they look at its instant, and where they are while it is exposed. Out: items.
#pragma once

#include <piblocks/image.hpp>

#include <span>
#include <variant>
#include <vector>

#include "draw/bodies/body_shapes.hpp"
#include "draw/composition.hpp"

namespace piblocks {

/// A body at the picture's instant. @see MovingShape
using StillBody = std::variant<ExposedBlock, DiscItem>;

/// Adds the bodies that stay, and an item of all that move.
/// @param bodies     in the order of the exposures'
/// @param exposures  none if the picture is that of its instant
void add_exposed(const std::vector<StillBody>& bodies, const BodyMap& map, const PixelRect& frame,
                 std::span<const WeightedBodyExposure> exposures, std::vector<DrawItem>& items);

}  // namespace piblocks
