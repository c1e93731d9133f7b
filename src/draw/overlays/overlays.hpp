// Overlays beside the stage: the count, the digits of pi that a film counts, a ruler, read-outs.
// In: a drawing context. Out: drawables, and texts.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

/// The count as the picture of its last collision shows it, if these are the digits of pi; else
/// empty.
/// @throws UsageError if they are not, and the scene asks for them.
std::string pi_count(const LayoutContext& context);

/// Length of the expected beginning of the count, with separators; 0 while it has fewer digits.
std::size_t lit_length(std::string_view count, std::string_view expected);

/// The longest count that the film shows. Counts before time 0 are negative and may be longer.
Integer longest_count(const Scene& scene, const Log& log);

/// What a plan must know of the counter.
CounterRoom counter_room(const LayoutContext& context, const std::string& pi_count);

/// The count, and the digits of pi that it has reached, each at the right end of its line.
/// @param pi_count  as above
Drawable counter(const LayoutContext& context, const CounterPlace& place,
                 const std::string& pi_count);

/// A scale of positions below the blocks. @throws UsageError if the view has no room there.
Drawable ruler(const DrawingContext& context);

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
