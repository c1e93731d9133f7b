// Which overlays and diagrams cannot be added to a picture.
// In: a scene that is open. Out: JSON.
#pragma once

#include <string>

#include "web/live.hpp"

namespace piblocks::web {

/// {"show.panels":{"NAME":"why it cannot be added",…},"show.overlays":{…}}; names that can be
/// added, or are shown, are not there.
std::string choices_json(const LiveScript& live);

}  // namespace piblocks::web
