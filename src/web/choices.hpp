// What can be added to a picture.
// In: a scene that is open. Out: JSON.
#pragma once

#include <string>

#include "web/live.hpp"

namespace piblocks::web {

/// {"show.panels":{"NAME":"why it cannot be added",…},"show.overlays":{…},"room":BODY}; names that
/// can be added, or are shown, are not there. BODY is body_json() of one more body where there is
/// room for it; null if there is none.
std::string choices_json(const LiveScript& live);

}  // namespace piblocks::web
