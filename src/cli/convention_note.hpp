// Says which of two equally good counts a command shows.
// In: the blocks of a scene. Out: a line on standard error if all collisions happen at once, when
// their number depends on a convention; nothing otherwise.
#pragma once

#include <piblocks/script.hpp>

namespace piblocks::cli {

/// @throws SceneError if problems_of(system) is not empty.
void note_convention(const BlockSystem& system);
/// Of every run.
void note_convention(const Script& script);

}  // namespace piblocks::cli
