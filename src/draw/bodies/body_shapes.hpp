// How large bodies are in the frame, and where.
// In: a layout of the stage. Out: what the painter of bodies and that of their walls read.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "draw/bodies/body_look.hpp"
#include "draw/draw_list.hpp"

namespace piblocks {

/// Where scene coordinates are in the frame.
struct BodyMap {
  double scale = 1;  ///< pixels per unit
  Point origin;      ///< of the scene's (0, 0)

  Point at(const std::array<double, 2>& position) const {
    return {origin.x + position[0] * scale, origin.y - position[1] * scale};
  }
};

struct BodyShape {
  double half_width_px = 0;  ///< or the radius
  double height_px = 0;      ///< of a block
  BodyColors colors;
  std::string label;
  double label_px = 0;       ///< width
  bool is_label_on = false;  ///< on the body, not above it
};

/// All bodies of a stage.
struct BodyShapes {
  std::vector<BodyShape> shapes;  ///< in the order of BodySystem::bodies
  BodyMap map;
  bool are_blocks = true;

  double tallest_px() const {
    return std::ranges::max_element(shapes, {}, &BodyShape::height_px)->height_px;
  }
};

}  // namespace piblocks
