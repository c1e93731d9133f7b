// The colours of bodies.
// In: a theme and the place of a body. Out: what fills it, its edge and the text on it.
#pragma once

#include "draw/layout.hpp"

namespace piblocks {

struct BodyColors {
  Color fill;
  Color edge;
  Color text;
};

/// The colour that the scene gives it; else those of blue and red, and further ones, in turn. A
/// body that no collision moves has the colour of walls.
BodyColors body_colors(const DrawingContext& context, std::size_t body);

}  // namespace piblocks
