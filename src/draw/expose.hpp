// Two blocks while the picture is exposed.
// In: the blocks as they are drawn at one instant, and where they are in the meantime. Out: a draw
// item with the places that each of them takes.
#pragma once

#include <piblocks/compose.hpp>

namespace piblocks {

/// @param red, blue  at the picture's instant, with a fill and a solid stroke.
ExposedItem expose(const RectangleItem& red, const RectangleItem& blue, const BlockSystem& system,
                   const Layout& layout, std::span<const ExposurePart> parts);

}  // namespace piblocks
