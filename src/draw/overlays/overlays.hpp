// Overlays beside the stage.
// In: a drawing context. Out: drawables.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

/// A scale of positions below the blocks. @throws UsageError if the view has no room there.
Drawable ruler(const DrawingContext& context);

/// The logo as large as fits, in the lower right corner of its place.
/// @throws UsageError if it would be a speck.
ImageItem place_logo(const Rect& place, std::shared_ptr<const Image> logo);

/// What it says; empty while time runs as elsewhere.
struct SlowMotionLabel {
  std::string widest;
  std::function<std::string(const FrameState&)> text;
};
SlowMotionLabel slow_motion_label(const LayoutContext& context);

/// All read-outs in rows; a Drawable adds them.
class ReadOutRows {
 public:
  /// @throws UsageError if one is too long to be read.
  explicit ReadOutRows(const LayoutContext& context);

  double height() const noexcept { return height_; }
  /// Width of the label of slow motion if it stands alone; rows need no room then. Else 0.
  double lone_slow_motion_px() const noexcept { return lone_px_; }
  /// Moves all rows down, or the lone label to its place.
  void move(double y, const Point& slow_motion);
  /// Fades the label of slow motion out as the loupe, which has the same label, fades in.
  /// @param opacity  of the loupe, 0 … 1
  void leave_slow_motion_to(std::function<double(const FrameState&)> opacity) {
    loupe_opacity_ = std::move(opacity);
  }
  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const;

 private:
  struct Placed {
    std::function<std::string(const FrameState&)> text;  ///< empty where there is nothing to say
    Color color;
    std::size_t room_bytes;  ///< of the text that takes most room
    double room_px;
    Point origin;
    bool is_slow_motion;
  };
  std::vector<Placed> placed_;
  std::function<double(const FrameState&)> loupe_opacity_;  ///< may be empty
  TextWidths widths_;
  double text_px_;
  Face face_;
  double height_ = 0;
  double lone_px_ = 0;
};

}  // namespace piblocks
