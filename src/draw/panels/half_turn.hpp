// Why the count is pi: how many wedge angles θ fit into half a turn.
// In: two blocks. Out: the ratio π/θ, as it is written in titles.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <optional>

#include "draw/layout.hpp"

namespace piblocks {

/// The square root of the ratio of masses, red over blue, if it is a whole number.
std::optional<Integer> whole_root(const TwoBlocks& system);

/// Whether the collisions are the whole multiples of θ in half a turn: blue waits at rest, and π/θ
/// is no whole number.
bool fits_half_turn(const TwoBlocks& system);

/// "π/θ ≈ 10π = 31.4…", or, where the root of the ratio of masses is not whole, "π/θ = 5.8…".
/// Digits are cut off, not rounded; none where they are too many to read.
Formula half_turn_ratio(const DrawingContext& context);

}  // namespace piblocks
