// How MP4 and MOV files count time.
#pragma once

#include <piblocks/exact.hpp>

#include <cstdint>

namespace piblocks {

/// The units a second in which they count.
std::int64_t units_per_second(const Rational& frame_rate);

/// @throws UsageError if a frame lasts longer than these files can say.
void check_duration_of_frame(const Rational& frame_rate);

}  // namespace piblocks
