// Walls of bodies: a floor with hatched ends, or a box of any straight walls.
// In: a drawing context of a scene with bodies, and where its bodies are. Out: items that stay.
#pragma once

#include <vector>

#include "draw/bodies/body_shapes.hpp"
#include "draw/layout.hpp"

namespace piblocks {

/// Walls reach so far above the tallest block, in fractions of the frame's shorter side.
inline constexpr double kWallAboveBodies = 0.03;

/// @param area  that the walls may fill, in pixels
std::vector<DrawItem> body_walls(const DrawingContext& context, const BodyShapes& bodies,
                                 const Rectangle& area);

}  // namespace piblocks
