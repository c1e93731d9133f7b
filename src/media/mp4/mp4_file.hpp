// What MP4 and MOV files can hold.
#pragma once

#include <piblocks/exact.hpp>

namespace piblocks {

/// @throws UsageError if a frame lasts longer than these files can say.
void check_duration_of_frame(const Rational& frame_rate);

}  // namespace piblocks
