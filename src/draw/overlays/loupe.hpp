// The loupe: an inset that shows a gap of a line enlarged.
// In: the stage and the gap. Out: drawables, and how much of the loupe is seen.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "draw/layout.hpp"
#include "draw/overlays/loupe_gap.hpp"
#include "draw/overlays/loupe_place.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/overlays/zoom.hpp"
#include "draw/stage/hits.hpp"

namespace piblocks {

class LoupeInset {
 public:
  /// Nothing if the scene has no loupe, or leaves it to the program and it would have no room or
  /// nothing to show.
  /// @throws UsageError as loupe_gap(); if the scene names a window, and the loupe has no room.
  static std::shared_ptr<const LoupeInset> make(const DrawingContext& context,
                                                const FramePlan& plan);

  /// 0 where it is not seen, 1 where it is seen in full: by the gap, and by the window.
  double opacity(const FrameState& shown) const;
  FrameNeeds needs() const noexcept { return gap_.needs(); }
  /// Whether it says how much slower time runs.
  bool shows_slow_motion() const noexcept { return bool(slow_text_); }

  /// Lines from the stage to the inset, behind the blocks.
  void add_lines(const FrameState& shown, std::vector<DrawItem>& items) const;
  /// The inset.
  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const;

 private:
  // Ids among those of the wall, and of both blocks.
  static constexpr std::size_t kFirstLine = 100;
  static constexpr std::size_t kAnchor = 1;
  static constexpr std::size_t kCut = 100;
  static constexpr std::size_t kSweep = 100;

  /// In the frame, not enlarged.
  double gap_px(const FrameState& shown) const;
  /// How many times the gap of a state could be enlarged.
  double most_zoom_of(const FrameState& state) const;
  /// The place of the zoom among zooms_, or between two of them.
  double level(const FrameState& shown) const;
  double zoom_at(double level, const FrameState& shown) const;
  /// All that does not depend on the place.
  LoupeInset(const DrawingContext& context, const LoupeGap& gap);
  LoupeTexts texts() const { return {widest_zoom_px_, shows_slow_motion()}; }
  void place(const DrawingContext& context, const LoupePlace& found);
  void place_scenery(const DrawingContext& context);
  /// Mirrored left to right if the anchor is on the right.
  Rect mirrored(const Rect& r) const;
  Point mirrored(const Point& p) const;

  DrawList picture(const FrameState& shown, double px_per_unit) const;
  void add_blocks(const FrameState& shown, double px_per_unit, std::vector<DrawItem>& items) const;
  void add_marks(const FrameState& shown, double px_per_unit, std::vector<DrawItem>& items) const;
  /// Where blocks are in the inset.
  struct SeenBlocks {
    std::optional<Rect> anchor;
    std::optional<Rect> between;
    Rect outer;
  };
  SeenBlocks blocks_of(const FrameState& shown, double px_per_unit) const;
  void add_between(const Rect& block, double seen, std::vector<DrawItem>& items) const;
  /// Where surfaces touch. @param left_px, right_px  heights, as seen from the anchor
  Contact contact_at(double x_px, double left_px, double right_px, const Color& color) const;
  void add_tear(const Rect& block, const Color& color, std::vector<DrawItem>& items) const;
  void add_zoom(double zoomed, const Color& color, std::vector<DrawItem>& items) const;

  LoupeGap gap_;
  Sizes sizes_;
  Palette palette_;
  Face face_;
  double frames_per_s_;
  std::optional<Color> background_;
  std::optional<double> window_zoom_;
  Zoom zoom_;
  std::vector<double> zooms_;  ///< rising: 1, 10, 100, … below the window's zoom, and that
  TextWidths widths_;
  std::vector<Formula> powers_;  ///< of ten, from the least one that is written as a power
  double widest_zoom_px_ = 0;
  std::function<std::string(const FrameState&)> slow_text_;  ///< may be empty
  Rect bounds_;                                              ///< in whole pixels of the frame
  Point zoom_end_;                 ///< right end of the zoom's baseline, in the frame
  bool is_zoom_end_left_ = false;  ///< whether zoom_end_ is the left end
  // Lines go from a place at the outer block to two corners of the inset; in the frame.
  Layout stage_;
  double lines_y_ = 0;
  std::array<Point, 2> corners_;
  // In the inset, as seen from the anchor.
  double slow_baseline_px_ = 0;
  double face_px_ = 0;     ///< of the anchor
  double between_px_ = 0;  ///< the block in between is cut to this; 0 if there is none
  double room_px_ = 0;     ///< for the gap
  double floor_px_ = 0;
  double inner_height_px_ = 0;  ///< of the block in between, else of the anchor
  double outer_height_px_ = 0;
  double anchor_height_px_ = 0;
  std::optional<BlockColors> anchor_;  ///< unless it is a wall
  BlockColors between_;
  BlockColors outer_;
  Color hit_color_;  ///< where the gap closes
  std::optional<HitMarks> marks_;
  PlateItem scenery_;
};

}  // namespace piblocks
