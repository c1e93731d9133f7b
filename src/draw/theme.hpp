// The colours of a theme, and what else tells the blocks apart.
// In: a theme's name. Out: a palette whose text meets WCAG 2.1's contrast of 4.5 : 1 (AA).
#pragma once

#include <piblocks/scene.hpp>

#include <optional>

#include "draw/draw_list.hpp"

namespace piblocks {

/// A block's colours.
struct BlockColors {
  Color fill;
  Color edge;
  Color text;  ///< of what is written on the block
  Color line;  ///< of its path in diagrams
  /// Bars across the block in its edge's colour, half of them near the upper edge and half near the
  /// lower one. They tell it from the other block without colours.
  int bars = 0;
  /// The block's name in the picture: its colour, or, where blocks are not red and blue, its side.
  const char* name = "";
  const char* full_name = name;  ///< where the name alone might be read as a direction
};

struct Palette {
  Color background;
  Color wall;
  BlockColors blue;
  BlockColors red;
  Color text;    ///< of what is read first
  Color muted;   ///< of labels
  Color accent;  ///< of what is lit or marks the present
  Color grid;    ///< of axes and rays: no text
  Color shade;   ///< of filled areas in diagrams: no text
};

Palette palette_of(Theme theme);

/// What is behind everything; nothing if the view is transparent.
std::optional<Color> background_of(const View& view);

}  // namespace piblocks
