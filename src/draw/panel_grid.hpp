// Places of diagrams side by side and one above the other.
// In: how many there are, and their area. Out: a place of the same size for each.
#pragma once

#include <cstddef>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

/// Least side of a diagram, in ems.
inline constexpr double kLeastPanel_em = 6;

/// The grid in which `count` panels come out largest, if possible not too small.
/// @param gap  between panels, in pixels
/// @param em   of their text, in pixels
std::vector<Rect> panel_grid(std::size_t count, const Rect& area, double gap, double em);

}  // namespace piblocks
