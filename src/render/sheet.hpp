// The pictures of a contact sheet.
// In: a scene and instants. Out: a draw list for each, and the line below it.
#pragma once

#include <piblocks/instant.hpp>
#include <piblocks/scene.hpp>

#include <vector>

#include "draw/sheet.hpp"

namespace piblocks {

/// @throws SceneError if problems_of(scene) is not empty; UsageError, DrawError, MediaError,
///         SimulationError
std::vector<CaptionedPicture> sheet_pictures(const Scene& scene,
                                             const std::vector<Instant>& instants);

}  // namespace piblocks
