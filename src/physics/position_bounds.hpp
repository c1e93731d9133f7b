// How exact a state is.
// In: a collision log and a time. Out: bounds for the positions of the state at it.
#pragma once

#include <piblocks/run.hpp>

#include <optional>

namespace piblocks {

/// What positions may be off by at most, in units of length.
struct PositionBounds {
  double blue = 0;
  double red = 0;
};

/// Of the state at `time`; nothing if the engine cannot say beforehand.
std::optional<PositionBounds> position_bounds(const CollisionLog& log, const Rational& time);

}  // namespace piblocks
