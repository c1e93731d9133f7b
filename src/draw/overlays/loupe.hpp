// The loupe: an inset that shows the gaps between wall, blue and red enlarged.
// In: the stage and its gaps. Out: drawables, and how much of the loupe is seen.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "draw/layout.hpp"
#include "draw/overlays/loupe_place.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/overlays/zoom.hpp"
#include "draw/stage/hits.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// Whether the loupe would be seen if it had room.
bool may_show_loupe(const LayoutContext& context, const AxisPlace& axis);

class LoupeInset {
 public:
  /// Nothing if the scene has no loupe, or leaves it to the program and it would have no room or
  /// nothing to show.
  /// @throws UsageError if the scene names a window, and the loupe has no room or no wall, or is
  ///         never seen in the window.
  static std::shared_ptr<const LoupeInset> make(const DrawingContext& context,
                                                const FramePlan& plan);

  /// 0 where it is not seen, 1 where it is seen in full: by the gap, and by the window.
  double opacity(const FrameState& shown) const;
  /// By how much gaps are enlarged. @param gap  y2
  double zoom(double gap) const;
  /// Whether it says how much slower time runs.
  bool shows_slow_motion() const noexcept { return bool(slow_text_); }

  /// Lines from the stage to the inset, behind the blocks.
  void add_lines(const FrameState& shown, std::vector<DrawItem>& items) const;
  /// The inset.
  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const;

 private:
  struct Window {
    Span span;
    double zoom = 1;
  };
  // Ids among those of the wall and of blue.
  static constexpr std::size_t kFirstLine = 100;
  static constexpr std::size_t kCut = 100;
  static constexpr std::size_t kSweep = 100;

  /// All that does not depend on the place. @param least_gap_px  that is shown
  LoupeInset(const DrawingContext& context, const Loupe& loupe, double least_gap_px);
  LoupeTexts texts() const { return {widest_zoom_px_, shows_slow_motion()}; }
  void place(const DrawingContext& context, const LoupePlace& found);
  void place_scenery(const DrawingContext& context);

  DrawList picture(const FrameState& shown, double zoomed) const;
  void add_blocks(const FrameState& shown, double px_per_unit, std::vector<DrawItem>& items) const;
  void add_marks(const FrameState& shown, double px_per_unit, std::vector<DrawItem>& items) const;
  void add_blue(double x_px, double seen, std::vector<DrawItem>& items) const;
  void add_zoom(double zoomed, const Color& color, std::vector<DrawItem>& items) const;

  TwoBlocks blocks_;
  Sizes sizes_;
  Palette palette_;
  Face face_;
  double scale_;  ///< of the stage, pixels per unit
  double frames_per_s_;
  double line_px_;  ///< of the blocks' outlines
  std::optional<Color> background_;
  std::optional<Window> window_;
  Zoom zoom_;
  TextWidths widths_;
  std::vector<Formula> powers_;  ///< of ten, from the least one that is written as a power
  double widest_zoom_px_ = 0;
  std::function<std::string(const FrameState&)> slow_text_;  ///< may be empty
  Rect bounds_;                                              ///< in whole pixels of the frame
  Point zoom_right_;  ///< right end of the zoom's baseline, in the frame
  // Lines go from a place at red to two corners of the inset; in the frame.
  Layout stage_;
  double lines_y_ = 0;
  std::array<Point, 2> corners_;
  // In the inset.
  double slow_baseline_px_ = 0;
  double face_px_ = 0;        ///< of the wall
  double blue_width_px_ = 0;  ///< blue is cut to this
  double room_px_ = 0;        ///< for the gap between wall and red, less blue
  double floor_px_ = 0;
  double blue_height_px_ = 0;
  double red_height_px_ = 0;
  std::optional<HitMarks> marks_;
  PlateItem scenery_;
};

}  // namespace piblocks
