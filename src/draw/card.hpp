// A title card: lines of text in the middle of the frame.
// In: the lines, and the view of the film. Out: a draw list.
#pragma once

#include <piblocks/scene.hpp>

#include <string>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

/// The first line is set as a heading; all are made smaller where they would not fit.
/// @param lines  at least one, not empty.
/// @throws UsageError if a line cannot be set, or is too long for the frame.
DrawList compose_card(const std::vector<std::string>& lines, const View& view);

}  // namespace piblocks
