// What the panels of the unfolded line say: titles and notes.
// In: a scene and its log. Out: formulas, with the numbers that are true of it.
#pragma once

#include <optional>
#include <vector>

#include "draw/layout.hpp"
#include "draw/panels/panels.hpp"
#include "draw/panels/unfolded_line.hpp"

namespace piblocks {

/// The path is straight; in the end, how many mirrors it has crossed, and why.
/// @param unfolds  whether mirrors appear one by one
PhasedTitle::Sentences unfolded_sentences(const DrawingContext& context, bool unfolds);

/// How many wedge angles fit into half a turn, as half_turn_text(); without digits in other bases.
std::optional<Formula> half_turn_ratio(const DrawingContext& context);

/// The wedge angle, as an expression and a number.
Formula angle_note(const DrawingContext& context);
/// How many of the mirrors are drawn; nothing if all are.
std::optional<Formula> thinning_note(const FormulaSetter& set, const std::vector<Mirror>& mirrors);

}  // namespace piblocks
