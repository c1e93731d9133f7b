// What stage and loupe are both made of.
// In: places in pixels. Out: items.
#pragma once

#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

/// Greatest distance of neighbouring doubles on the axis.
inline constexpr double kMostStep_px = 0.25;
/// A block is higher by this for every factor of ten in mass, in heights of the lightest.
inline constexpr double kHeightByMass = 0.25;
/// Of the stage, in fractions of the frame's shorter side.
inline constexpr double kLeastHeight = 0.05;

/// Whether the view has the wall's face in it.
bool shows_wall(const Scene& scene);

/// A wall from top to bottom; nothing is left of its hatch.
struct WallPlace {
  double face_px = 0;
  double top_px = 0;
  double bottom_px = 0;
};

/// The wall's face, and lines of 45 degrees behind it.
std::vector<DrawItem> wall_items(const WallPlace& place, const DrawingContext& context);

/// A block in the colours and with the bars of the theme.
ExposedBlock block_at(const Rectangle& bounds, const BlockColors& colors, double line_px);

/// Items that never change. @param bounds  around them; they become whole pixels
PlateItem plate_of(ItemId id, const Rectangle& bounds, std::vector<DrawItem> items);

}  // namespace piblocks
