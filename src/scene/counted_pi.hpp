// How pi comes into the count of a run.
// In: two blocks beside a wall, and a base. Out: digits, if the count is made of them; the number
// of angles in half a turn.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <optional>
#include <string>

namespace piblocks {

/// How many digits of pi after the point the count has in this base, save for the last digit of a
/// few counts. Nothing unless blue is at rest, off the wall, and the mass ratio is a power of the
/// base's square.
std::optional<unsigned long> places_of_pi(const TwoBlocks& system, int base);

/// Pi in this base, with as many digits as the count: "3.14". Empty if the count has other digits.
/// @param total  all collisions of the run
std::string counted_pi(const TwoBlocks& system, const Integer& total, int base);

/// How many angles θ = arctan √(m1/m2) half a turn has; the whole part is the count: "π/θ = 5.8…",
/// or "π/θ ≈ 10π = 31.4…" if m2/m1 is the square of 10 or more and both have the same whole part.
/// Decimals are cut off. Empty from a million on, and unless blue is at rest, off the wall, all
/// collisions are elastic, and π/θ is no whole number.
std::string half_turn_text(const TwoBlocks& system);

}  // namespace piblocks
