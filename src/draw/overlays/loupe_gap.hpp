// Which gap of a line the loupe enlarges.
// In: a scene and its log. Out: the bodies beside the gap, and how wide it is.
#pragma once

#include <cstddef>
#include <optional>

#include "draw/layout.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// Of two blocks beside something immovable: from there to red, with blue in between. Of other
/// bodies: between the two that meet first in the loupe's window.
struct LoupeGap {
  std::size_t anchor = 0;                   ///< keeps its place: a body; or a wall, as in MetPair
  std::size_t outer = 1;                    ///< the body on the other side
  std::optional<std::size_t> between = {};  ///< a block in the gap, which is not enlarged
  int side = 1;                             ///< -1: outer is on the left
  double face = 0;                          ///< position of the anchor if that is a wall
  double meeting = 0;                       ///< where they meet, unless a block is in between
  double least_px = 0;                      ///< of what it shows, in pixels of the stage
  std::optional<Span> window = {};          ///< in which it is shown
  bool is_stage = false;                    ///< it is as wide as most of the frame

  /// The two that meet when the gap closes; of three, the one in between and the outer one.
  MetPair meeting_pair() const noexcept;
  FrameNeeds needs() const noexcept {
    return {.gaps = between.has_value(), .moments = true, .hits = between.has_value()};
  }
  /// The loupe enlarges y2. Without a block in between y1 and y2 are both the gap, computed from
  /// positions, which are doubles.
  Gaps gaps_in(const FrameState& shown, const Layout& layout) const;
};

/// Nothing if the scene has no loupe, or leaves it to the program and there is nothing to show.
/// @throws UsageError if the scene names a window in which there is nothing to show.
std::optional<LoupeGap> loupe_gap(const DrawingContext& context);

/// Whether the scene has a loupe that is as wide as most of the frame.
bool has_stage_loupe(const Show& show);

/// Whether the loupe would be seen if it had room.
bool may_show_loupe(const LayoutContext& context, const AxisPlace& axis);

}  // namespace piblocks
