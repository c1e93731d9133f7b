// Who gets which part of the frame.
// In: what a scene shows. Out: places that do not overlap, for any shape of frame.
#pragma once

#include <vector>

#include "draw/font.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {

struct FramePlan {
  double text_px = 0;  ///< of what is read beside the blocks
  double line_px = 1;
  std::optional<TextItem> title;
  std::optional<TextItem> caption;
  Rectangle logo;  ///< empty unless asked for
  Rectangle stage;
  std::vector<Rectangle> panels;
};

/// Below this no font can be read.
inline constexpr double kLeastText_px = 8;

/// Type of read-outs and diagrams in a frame.
double small_text_px(const View& view);

/// As wide as read-outs may be; their rows begin at its top.
Rectangle read_out_area(const View& view);

/// @param read_outs_px  height of their rows, which are put below the stage.
/// @throws UsageError if a line cannot be set or is too long, or diagrams get too small.
FramePlan plan_frame(const Scene& scene, const Palette& palette, const Font& font,
                     double read_outs_px);

}  // namespace piblocks
