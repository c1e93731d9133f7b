// What a comparison found, in words.
// In: the comparison of a frame. Out: a line for people, the same in every report.
#pragma once

#include <piblocks/compare.hpp>

#include <string>

namespace piblocks {

/// "3 pixels differ, largest delta 200, first at x=10 y=20 (red), densest …".
std::string describe(const FrameComparison& frame);

}  // namespace piblocks
