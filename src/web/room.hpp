// Where one more body would have room.
// In: a scene with bodies. Out: a body at rest.
#pragma once

#include <piblocks/scene.hpp>

#include <optional>

namespace piblocks::web {

/// In the middle of the largest gap of a line, or where a plane has the most room, between walls,
/// bodies and the edge of the view; of mass 1, and no larger than the others are on average.
/// Nothing if there is no room.
std::optional<Body> body_with_room(const Scene& scene);

}  // namespace piblocks::web
