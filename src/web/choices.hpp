// What a scene can be changed to: where sliders may go, what can be added to the picture.
// In: a scene that is open. Out: JSON; a body at rest.
#pragma once

#include <piblocks/script.hpp>

#include <optional>
#include <string>

#include "web/live.hpp"

namespace piblocks::web {

/// @param builder  of the scene that is shown
/// @returns for keys the values that it accepts, all else unchanged:
/// {"blue.position":[low,high],…}: positions between the wall, the other block and the edge of the
/// view, widths up to the gap, and the usual range of other keys; less where the scene refuses
/// parts of it. Empty for a storyboard.
std::string ranges_json(const ScriptBuilder& builder, const LiveScript& live);

/// In the middle of the largest gap of a line, or where a plane has the most room, between walls,
/// bodies and the edge of the view; of mass 1, and no larger than the others are on average.
/// Nothing if there is no room.
std::optional<Body> body_with_room(const Scene& scene);

/// {"show.panels":{"NAME":"why it cannot be added",…},"show.overlays":{…},"room":BODY}; names that
/// can be added, or are shown, are not there. BODY is body_json() of one more body where there is
/// room for it; null if there is none.
std::string choices_json(const LiveScript& live);

}  // namespace piblocks::web
