// A state without the blocks' widths: the two gaps that the diagrams show.
// In: a system and states of it. Out: y1, blue's distance from the wall, and y2, red's distance
// less the widths between, so that 0 <= y1 <= y2, with equality where something meets.
#pragma once

#include <piblocks/interpolator.hpp>
#include <piblocks/scene.hpp>

#include <cmath>

#include "draw/number_text.hpp"

namespace piblocks {

struct GapPoint {
  double y1 = 0;
  double y2 = 0;
};

struct PanelGaps {
  explicit PanelGaps(const BlockSystem& system)
      : blue_offset(to_double(system.wall_face + system.blue.width / 2)),
        red_offset(to_double(system.wall_face + system.blue.width + system.red.width / 2)),
        sigma(root_of(system.blue.mass / system.red.mass)),
        theta(std::atan(sigma)) {}

  GapPoint of(const Motion& blue, const Motion& red) const {
    return {blue.position - blue_offset, red.position - red_offset};
  }
  GapPoint of(const BlockState& state) const { return of(state.blue, state.red); }

  double blue_offset;
  double red_offset;
  double sigma;  ///< sqrt(m_blue/m_red)
  double theta;  ///< the wedge's angle, atan(sigma)
};

}  // namespace piblocks
