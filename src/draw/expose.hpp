// Two blocks while the picture is exposed.
// In: the blocks as they are drawn at one instant, and their exposures. Out: a draw item with the
// places of each; or plain rectangles, of blocks that are not exposed.
#pragma once

#include <span>
#include <vector>

#include "draw/composition.hpp"

namespace piblocks {

/// From positions of the scene to columns of the frame.
struct SceneColumns {
  double zero_px = 0;  ///< where the scene's 0 is
  double scale = 1;    ///< pixels per unit of the scene
  int width_px = 0;    ///< of the frame
};

/// @param red, blue  at the picture's instant, without dwells
ExposedItem exposed_item(ExposedBlock red, ExposedBlock blue, const SceneColumns& columns,
                         std::span<const WeightedExposure> exposures);

/// Adds a block that stays: a rectangle for it, and one for each of its bars.
void add_rectangles(ItemId id, const ExposedBlock& block, std::vector<DrawItem>& items);

}  // namespace piblocks
