// Any bodies and the walls of their box: blocks on a floor, or discs in a plane.
// In: a drawing context of a scene with bodies, and an area of the frame. Out: a drawable.
#pragma once

#include "draw/layout.hpp"

namespace piblocks {

/// @param area  of the frame, for the bodies and what is on them
/// @throws UsageError if the area is too small to show them.
Drawable body_stage(const DrawingContext& context, const Rectangle& area);

}  // namespace piblocks
