// Where the loupe is.
// In: what else is in the frame. Out: a place that is clear of it all.
#pragma once

#include <optional>

#include "draw/layout.hpp"
#include "draw/overlays/loupe_gap.hpp"

namespace piblocks {

struct LoupePlace {
  Rect bounds;         ///< in whole pixels of the frame
  double rows_px = 0;  ///< height of its rows of text
  bool is_zoom_beside = true;
  double lines_px = 0;  ///< where lines to an inset above the blocks begin
};

/// What the inset has to have room for.
struct LoupeTexts {
  double zoom_px = 0;  ///< width of the longest zoom
  bool has_slow_motion = false;
};

/// Width of the inset, in pixels.
double loupe_width_px(const View& view, const Sizes& sizes, bool is_stage);

/// Room for the inset beside two blocks, on the side that they leave to; or above all blocks.
/// Nothing if there is none.
std::optional<LoupePlace> find_loupe_place(const DrawingContext& context, const FramePlan& plan,
                                           const LoupeGap& gap, const LoupeTexts& texts);

/// Proportions of the inset.
namespace loupe_style {

// In fractions of the frame's shorter side.
inline constexpr double kBelowFloor = 0.025;
inline constexpr double kAboveBlocks = 0.015;
inline constexpr double kInside = 0.012;   ///< between the inset's edges and what is in it
inline constexpr double kOutside = 0.025;  ///< between the inset and what is around it

inline constexpr double kRow_em = 1.35;  ///< from one row of text to the next
/// From this exponent on a zoom is written as a power of ten.
inline constexpr long kLeastPower = 4;
/// The loupe is seen in full below this share of the gap at which it begins to be seen.
inline constexpr double kFullyShown = 0.5;

}  // namespace loupe_style

}  // namespace piblocks
