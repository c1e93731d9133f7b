// What MP4 and MOV files can hold.
#pragma once

#include <piblocks/exact.hpp>

namespace piblocks {

/// The units a second in which MP4 and MOV files count: the frame rate's numerator, doubled up to
/// 10,000, as libavformat does.
Integer units_per_second(const Rational& frame_rate);

/// @throws UsageError if a frame lasts longer than these files can say.
void check_duration_of_frame(const Rational& frame_rate);

}  // namespace piblocks
