// The look of every picture: colours, sizes of type, lines and margins.
// In: a theme, own colours, a frame or an area of it. Out: a palette, lengths in pixels.
// An overlay or panel has its own proportions in its file.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

struct BlockColors {
  Color fill;
  Color edge;
  Color text;   ///< of what is written on the block
  Color line;   ///< of its path in diagrams, and of marks of its hits
  Color label;  ///< of text about it on the background
  /// Bars across the block in its edge's colour, half of them near each of the upper and the lower
  /// edge. They tell it from the other block without colours.
  int bars = 0;
  /// The block's name in the picture: its colour, or, where blocks are not red and blue, its size
  /// or its side.
  const char* name = "";
  /// Where the name alone might be read as a direction.
  std::string full_name() const;
};

/// On the background, text has a contrast of at least 4.5, a line of 3 and a filled area of 2.
struct Palette {
  Color background;
  Color wall;  ///< and floor
  BlockColors blue;
  BlockColors red;
  Color text;    ///< of what is read first
  Color muted;   ///< of labels
  Color accent;  ///< of what is lit or marks the present
  Color done;    ///< of what says that no more collisions come
  Color grid;    ///< of axes and rays: no text
  Color shade;   ///< of filled areas in diagrams: no text
};

/// @param own  stays as it is; what follows from it keeps to these contrasts where it can
Palette palette_of(Theme theme, const Colors& own = {});
inline Palette palette_of(const View& view) { return palette_of(view.theme, view.colors); }
/// The same for two blocks beside something immovable, which are blue and red in diagrams.
/// @param colors  of the bodies
Palette palette_of(const View& view, const TwoBlocks& blocks,
                   const std::vector<BlockColors>& colors);

/// Of each body: the colour that the scene gives it; else by mass: blue for the lightest, red for
/// the heaviest, further ones for those between. Where all masses are equal these colours follow in
/// turn. Blue and red of a scene with short names have their own. Of very many bodies all but the
/// heaviest are blue. A body with a colour of its own does not change those of others. A body that
/// no collision moves has the colour of walls. Two blocks beside something immovable have names:
/// their colours if these are the theme's, and have names; else they are large and small, or left
/// and right if their masses are equal.
/// @param blocks  nullptr for other bodies
std::vector<BlockColors> colors_of(const Scene& scene, const TwoBlocks* blocks);

/// Nothing if the view is transparent.
std::optional<Color> background_of(const View& view);

/// Which colours of a script's own have less contrast to the background than Palette says, a line
/// each, of a dozen at most. Of what is behind a transparent picture nothing is known.
std::vector<std::string> contrast_notes(const Script& script);

/// The typeface of plain text.
inline Face text_face_of(Theme theme) {
  return theme == Theme::article ? Face::article : Face::text;
}

/// The color with this share of its alpha.
inline Color faded(Color color, double share) {
  color.alpha = static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * color.alpha));
  return color;
}

// Fractions of the frame's shorter side.
namespace style {

inline constexpr double kMargin = 0.06;
inline constexpr double kGap = 0.04;  ///< between things side by side

// A picture lower than this is a row of a split screen. It has less of a margin above and below;
// the rest of it is around all rows.
inline constexpr double kRow = 0.55;
inline constexpr double kRowMargin = 0.03;

// Sizes of type. Nothing is smaller than kLeastType: what does not fit is left out or rejected.
inline constexpr double kCounter = 0.15;
inline constexpr double kTitle = 0.055;
inline constexpr double kMass = 0.042;
inline constexpr double kText = 0.036;
inline constexpr double kLeastType = 0.033;

// Widths of lines.
inline constexpr double kWallLine = 0.005;  ///< and floor
inline constexpr double kDataLine = 0.0035;
inline constexpr double kGridLine = 1.5 / 720;  ///< the thinnest that a projector of 720 rows shows

// Radii of dots in diagrams.
inline constexpr double kPresentDot = 0.011;
inline constexpr double kHitDot = 0.0055;

/// Opacity of a filled area behind text or lines. It keeps a contrast of 2 with the background.
inline constexpr double kWedgeFill = 0.8;

inline constexpr double kProtractor = 0.38;  ///< radius of the arc around equal angles, at most

inline constexpr double kCorner = 0.004;  ///< radius of blocks' corners in the lecture themes
inline constexpr double kWallWidth = 0.025;
inline constexpr double kHitReach = 0.06;  ///< how far the mark of a hit grows
inline constexpr double kLoupeWidth = 0.36;
inline constexpr double kMaxLoupeGap = 0.1;     ///< the loupe shows smaller gaps
inline constexpr double kMaxHeightRatio = 2.2;  ///< of the heavier block to the lighter one

// The picture in the corner, at most.
inline constexpr double kLogoWidth = 0.24;
inline constexpr double kLogoHeight = 0.09;

inline constexpr double kCardHeading = 0.12;
inline constexpr double kCardLine = 0.06;
inline constexpr double kCardMargin = 0.09;

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

// Of the article's picture, in fractions of its height, or of less where it is narrow.
namespace article_style {

inline constexpr double kMargin = 0.045;
inline constexpr double kCounter = 0.074;
inline constexpr double kLine = 0.0032;
/// Where the height is less than this fraction of the width, the height counts.
inline constexpr double kNarrow = 0.75;

inline double short_measure(const Rect& area) {
  return std::min(area.height, kNarrow * area.width);
}

}  // namespace article_style

inline Rect whole(const View& view) {
  return {0, 0, double(view.width_px), double(view.height_px)};
}

/// Lengths of the look in a frame, in pixels.
struct Sizes {
  explicit Sizes(const View& view)
      : short_side(view.short_side_px > 0 ? view.short_side_px
                                          : std::min(view.width_px, view.height_px)),
        margin(style::kMargin * short_side),
        gap(style::kGap * short_side),
        title(type(style::kTitle)),
        mass(type(style::kMass)),
        text(type(style::kText)),
        wall_line(std::max(1.0, style::kWallLine * short_side)),
        data_line(std::max(1.0, style::kDataLine * short_side)),
        grid_line(std::max(1.0, style::kGridLine * short_side)),
        corner(is_lecture(view.theme) ? style::kCorner * short_side : 0) {}

  double type(double fraction) const {
    return std::max(style::kLeastText_px, fraction * short_side);
  }

  double short_side;  ///< the frame's shorter side, or that of the whole film
  double margin;
  double gap;
  // Of the em.
  double title;
  double mass;
  double text;
  // Widths of lines.
  double wall_line;
  double data_line;
  double grid_line;
  double corner;  ///< radius of blocks' corners
};

}  // namespace piblocks
