// Bodies at one instant or exposed, with their labels, trails and velocities.
// In: a drawing context of a scene with bodies, and their shapes. Out: a drawable.
#pragma once

#include "draw/bodies/body_shapes.hpp"
#include "draw/layout.hpp"

namespace piblocks {

/// Labels are so far above blocks, and arrows of velocities farther by that much, in fractions of
/// the frame's shorter side.
inline constexpr double kLabelAbove = 0.014;
inline constexpr double kArrowAbove = 0.03;

Drawable body_painter(const DrawingContext& context, BodyShapes bodies);

}  // namespace piblocks
