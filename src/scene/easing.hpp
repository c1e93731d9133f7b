// Slow motion that sets in and ends gradually.
// In: moves with jumps of speed between them. Out: the same with short steps in place of the jumps.
#pragma once

#include <piblocks/exact.hpp>

#include <vector>

#include "scene/pacing.hpp"

namespace piblocks {

/// The same moves, with steps along a smooth curve from one speed to the next. The slower of two
/// moves stays as it is; the steps replace a part of the faster one. If the faster move is too
/// short, its steps are shorter. A freeze begins and ends at once.
/// @param ease_s  how long a change of speed takes, in seconds of video at `speed`; >= 0
/// @param speed   simulation time per second of video where nothing is slower; > 0
std::vector<Move> eased(const std::vector<Move>& moves, const Rational& ease_s,
                        const Rational& speed);

}  // namespace piblocks
