// Rods of unit width, for the event simulator on a line.
#pragma once

#include <piblocks/event_simulator.hpp>

namespace piblocks {

using Rod = Particle<double, 1>;

inline Rod rod(double mass, double position, double velocity) {
  return {mass, 0.5, Rod::Vector(position), Rod::Vector(velocity)};
}

}  // namespace piblocks
