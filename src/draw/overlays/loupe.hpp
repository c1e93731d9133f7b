// The loupe: an inset that shows a gap of a line enlarged.
// In: a scene, its log, the stage. Out: which gap it shows, where it is clear of all else,
// drawables, and how much of it is seen.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "draw/layout.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/overlays/zoom.hpp"
#include "draw/stage/hits.hpp"
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

/// Whether the loupe would be seen if it had room.
bool may_show_loupe(const LayoutContext& context, const AxisPlace& axis);

struct LoupePlace {
  Rect bounds;         ///< in whole pixels of the frame
  double rows_px = 0;  ///< height of its rows of text
  bool is_zoom_beside = true;
  double lines_px = 0;  ///< where lines to an inset above the blocks begin
};

class LoupeInset {
 public:
  /// Between the inset's edges and what is in it, in fractions of the frame's shorter side.
  static constexpr double kInside = 0.012;

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
  /// From this exponent on a zoom is written as a power of ten.
  static constexpr long kLeastPower = 4;
  // Ids among those of the wall, and of both blocks.
  static constexpr std::size_t kFirstLine = 100;
  static constexpr std::size_t kAnchor = 1;
  static constexpr std::size_t kCut = 100;
  static constexpr std::size_t kSweep = 100;

  /// In the frame, not enlarged.
  double gap_px(const FrameState& shown) const;
  /// The place of the zoom among zooms_, or between two of them.
  double level(const FrameState& shown) const;
  double zoom_at(double level, const FrameState& shown) const;
  /// All that does not depend on the place.
  LoupeInset(const DrawingContext& context, const LoupeGap& gap);
  void place(const DrawingContext& context, const LoupePlace& found);
  void place_scenery();
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
