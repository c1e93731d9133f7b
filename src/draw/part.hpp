// One thing in the picture: an overlay or a diagram, in a file of its own.
// In: a setting, once; what is shown, for every frame. Out: items, in the order of their ids.
#pragma once

#include <vector>

#include "draw/composition.hpp"
#include "draw/font.hpp"
#include "draw/stage.hpp"
#include "draw/theme.hpp"

namespace piblocks {

/// What parts are set up from; it does not outlive the set-up.
struct Setting {
  const Scene& scene;
  const CollisionLog& log;
  const Palette& palette;
  const Font& font;
  const Layout& stage;
  double text_px;  ///< of what is read beside the blocks
  double line_px;
};

/// Const members are thread-safe.
class PicturePart {
 public:
  PicturePart() = default;
  virtual ~PicturePart() = default;
  PicturePart(const PicturePart&) = delete;
  PicturePart& operator=(const PicturePart&) = delete;

  virtual void add(const FrameState& shown, std::vector<DrawItem>& items) const = 0;
};

}  // namespace piblocks
