// The digits of pi that a run counts.
// In: two blocks beside a wall, and a base. Out: digits, if the count is made of them.
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

}  // namespace piblocks
