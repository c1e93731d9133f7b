// Diagrams of any bodies.
// In: a drawing context of a scene with bodies, and the place of the panel. Out: a drawable.
#pragma once

#include "draw/panels/panels.hpp"

namespace piblocks {

/// Where each block is, against time.
Drawable positions_panel(const DrawingContext& context, const PanelPlace& place);
/// How many discs or blocks have which speed, and the distribution that Maxwell found.
/// @throws UsageError if there are too few.
Drawable speeds_panel(const DrawingContext& context, const PanelPlace& place);
/// The squared distance of the centres of the two discs that meet first, against time. It is
/// (r₁ + r₂)² twice: when they touch, and when they would part if they passed through each other.
/// @throws UsageError if no two discs meet.
Drawable separation_panel(const DrawingContext& context, const PanelPlace& place);

}  // namespace piblocks
