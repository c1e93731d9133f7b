// The look of every picture: colours, sizes of type, lines and margins.
// In: a theme, a frame or an area of it. Out: a palette, lengths in pixels.
// An overlay or panel has its own proportions in its file.
#pragma once

#include <piblocks/scene.hpp>

#include <algorithm>
#include <optional>

#include "draw/draw_list.hpp"

namespace piblocks {

struct BlockColors {
  Color fill;
  Color edge;
  Color text;  ///< of what is written on the block
  Color line;  ///< of its path in diagrams
  /// Bars across the block in its edge's colour, half of them near each of the upper and the lower
  /// edge. They tell it from the other block without colours.
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

/// Nothing if the view is transparent.
std::optional<Color> background_of(const View& view);

// Fractions of the short measure, see below.
namespace style {

inline constexpr double kMargin = 0.045;
inline constexpr double kCardMargin = 0.09;
inline constexpr double kPanelGap = 0.035;

// Sizes of type.
inline constexpr double kCounter = 0.074;
inline constexpr double kTitle = 0.06;
inline constexpr double kCaption = 0.036;
inline constexpr double kSmall = 0.026;  ///< read-outs and diagrams
inline constexpr double kCardHeading = 0.12;
inline constexpr double kCardLine = 0.06;

inline constexpr double kLine = 0.0032;  ///< the unit of line widths

// The picture in the corner, at most.
inline constexpr double kLogoWidth = 0.24;
inline constexpr double kLogoHeight = 0.09;

// Of a sheet, in fractions of the page's shorter side.
inline constexpr double kSheetMargin = 0.05;
inline constexpr double kSheetGap = 0.025;
inline constexpr double kSheetCaption = 0.018;
inline constexpr double kSheetLine = 1.0 / 1200;
inline constexpr Color kSheetPaper = {255, 255, 255};
inline constexpr Color kSheetFrame = {144, 144, 144};
inline constexpr Color kSheetText = {32, 32, 32};

/// Below this no font can be read.
inline constexpr double kLeastText_px = 8;

}  // namespace style

/// Where the height is less than this fraction of the width, the height counts.
inline constexpr double kNarrow = 0.75;
/// What type, lines and margins are fractions of: the area's height, or less where it is narrow.
inline double short_measure(const Rectangle& area) {
  return std::min(area.height, kNarrow * area.width);
}

inline Rectangle whole(const View& view) {
  return {0, 0, double(view.width_px), double(view.height_px)};
}

inline double short_measure(const View& view) { return short_measure(whole(view)); }

inline double line_width_px(const View& view) { return style::kLine * short_measure(view); }

}  // namespace piblocks
