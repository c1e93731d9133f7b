// Several pictures in one frame, and one picture over another.
// In: draw lists. Out: a draw list that shows them.
#pragma once

#include <piblocks/scene.hpp>

#include <optional>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

/// The frame in equal cells: side by side, or one above the other if it is not wider than high.
class SplitScreen {
 public:
  /// @throws UsageError if the frame is too small for so many.
  SplitScreen(const View& view, std::size_t count);

  /// Whole pixels that do not overlap, in order.
  const std::vector<PixelRect>& cells() const noexcept { return cells_; }
  /// @param pictures  one for each cell, of its size.
  DrawList compose(std::vector<DrawList> pictures) const;

 private:
  DrawList empty_;  ///< with what is between the cells
  std::vector<PixelRect> cells_;
};

/// The second picture over the first, both of one size. @param opacity  of the second, 0 … 1.
DrawList cross_fade(DrawList from, DrawList to, double opacity);

}  // namespace piblocks
