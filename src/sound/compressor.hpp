// Compresses impulses to heights of clicks.
// In: clacks with their impulses, in order. Out: the height of the click that each becomes.
#pragma once

#include <cstddef>
#include <span>

#include "sound/clack_stream.hpp"

namespace piblocks {

/// Clacks closer than this are heard together, the less the farther apart.
inline constexpr int kTogether_samples = 4;

/// What becomes of an impulse: of a small one itself, of 1 0.8, of 100 3.2, and of none 8 or more.
/// Those that come within one sample grow like the mass ratio, without limit in the number of
/// digits.
double compressed(double impulse);

/// The height of the click for clack `index`. The impulses around it decide how much it is
/// compressed, so that a crowd of collisions is as loud as one blow of all of them.
/// @param clacks  those within kTogether_samples of it included, in the order of `sample`.
double height(std::span<const Clack> clacks, std::size_t index);

}  // namespace piblocks
