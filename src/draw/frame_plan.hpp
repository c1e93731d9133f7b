// Which place of the frame each thing gets.
// In: what a scene shows. Out: places that do not overlap, for any shape of frame.
#pragma once

#include <optional>
#include <vector>

#include "draw/drawable.hpp"

namespace piblocks {

struct FramePlan {
  std::optional<TextItem> title;
  std::optional<TextItem> caption;
  Rectangle logo;  ///< empty unless asked for
  Rectangle stage;
  std::vector<Rectangle> panels;
};

/// @param setting       its layout is not read.
/// @param read_outs_px  height of their rows, which are below the stage
/// @throws UsageError if a line cannot be set or is too long, or something gets too small.
FramePlan plan_frame(const Setting& setting, double read_outs_px);

}  // namespace piblocks
