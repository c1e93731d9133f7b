// The picture of one instant.
// In: a script and an instant. Out: its draw list, which is that of the film's frame.
#pragma once

#include <piblocks/instant.hpp>
#include <piblocks/script.hpp>

#include "draw/draw_list.hpp"

namespace piblocks {

/// What render_still() draws: the first frame of the film that shows the instant or, if no frame
/// does, what still_time() says.
/// @throws SceneError if problems_of() the script is not empty; UsageError, DrawError, MediaError,
///         SimulationError
DrawList still_picture(const Script& script, const Instant& instant);

}  // namespace piblocks
