// The stage and all overlays.
// In: a drawing context. Out: drawables.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

// Room for overlays around the blocks, in fractions of the frame's shorter side.
inline constexpr double kArrowRoom = 0.08;
inline constexpr double kMassRoom = 0.052;
inline constexpr double kRulerRoom = 0.07;

/// The floor is on whole pixels, and room above the blocks may be short by one.
inline constexpr double kRounded_px = 1;

/// From this size on, a unit of the scene is rounded to an even number of pixels. That makes edges
/// that do not move sharp, and in the article's picture the upper and lower edges of blocks of
/// width 1.
inline constexpr double kLeastRounded_px = 16;

/// Room that a mass needs above its block, in pixels.
double mass_room_px(const Sizes& sizes);
/// Room that the scene's overlays need above the taller block, in pixels.
double room_above_px(const Scene& scene, const Layout& layout, const Font& font);
/// The same below the floor.
double room_below_px(const Scene& scene);

/// The article's picture: wall, blocks and counter.
/// @param lit_digits  light up when the counter shows them in their places; may be empty
/// @param behind      is drawn before the blocks; may be empty
Drawable article_stage(const DrawingContext& context, std::string lit_digits, Drawable behind);

/// Wall, floor and blocks. @param behind  is drawn before the blocks; may be empty
Drawable stage(const DrawingContext& context, Drawable behind);

/// Each block's mass, on it or, if that is too narrow for the heavier one's, above it.
/// @throws UsageError if the lighter block is too narrow.
Drawable mass_labels(const DrawingContext& context);
/// Whether one mass is above its block.
bool has_mass_above(const Scene& scene, const Layout& layout, const Font& font);

/// Arrows above the blocks, with figures. Velocities of one run differ by the square root of the
/// mass ratio, so lengths grow less and less with the velocity, up to a longest one.
/// @throws UsageError if the view has no room above the blocks.
Drawable velocity_arrows(const DrawingContext& context);

/// A scale of positions below the blocks. @throws UsageError if the view has no room there.
Drawable ruler(const DrawingContext& context);

/// The logo as large as fits, in the lower right corner of its place.
/// @throws UsageError if it would be a speck.
ImageItem place_logo(const Rectangle& place, std::shared_ptr<const Image> logo);

/// What it says; empty while time runs as elsewhere.
struct SlowMotionLabel {
  std::string widest;
  std::function<std::string(const FrameState&)> text;
};
SlowMotionLabel slow_motion_label(const DrawingContext& context);

/// All read-outs in rows. A Drawable.
class ReadOutRows {
 public:
  /// @throws UsageError if one is too long to be read.
  explicit ReadOutRows(const DrawingContext& context);

  double height() const noexcept { return height_; }
  /// Width of the label of slow motion if it stands alone; rows need no room then. Else 0.
  double lone_slow_motion_px() const noexcept { return lone_px_; }
  /// Moves all rows down, or the lone label to its place.
  void move(double y, const Point& slow_motion);
  /// Fades the label of slow motion out as the loupe, which has the same label, fades in. @param
  /// opacity  of the loupe, 0 … 1
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
