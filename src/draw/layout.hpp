// Which place of the frame each thing gets, and what it is drawn from.
// In: a scene and its collision log. Out: places that do not overlap, for any shape of frame.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "draw/font.hpp"
#include "draw/formula.hpp"
#include "draw/look.hpp"

namespace piblocks {

/// Label and count of the article's picture.
struct CountLine {
  double text_px = 16;
  Point label;          ///< baseline of "Collisions: "
  double label_em = 0;  ///< from there to where the count starts
  double count_em = 0;  ///< width of the longest count
  double left_px = 0;   ///< label and count begin here or to the right
  double room_px = 0;   ///< and are no longer than this together
};

/// A block as it is drawn. Its width is that of the scene; its height is a matter of the look.
struct BlockShape {
  double width = 1;  ///< in units of the scene
  double height_px = 1;
};

/// The stage: the map from scene to pixels. It depends on the area and on the longest count alone,
/// so that nothing shifts while the counter grows.
struct Layout {
  double scale = 1;                     ///< pixels per unit of the scene
  Point origin;                         ///< pixel position of the scene's (0, 0)
  double visible_right_px = 0;          ///< blocks are seen up to here
  double line_px = 1;                   ///< of the bodies' outlines
  double corner_px = 0;                 ///< radius of the blocks' corners
  std::vector<BlockShape> shapes = {};  ///< of all bodies; discs are as high as wide
  CountLine count_line = {};            ///< of the article's picture alone

  // Of blocks on a line.
  double floor_px = 0;  ///< the blocks stand on it
  double above_px = 0;  ///< room above the tallest block
  double below_px = 0;  ///< room below the floor
  double wall_bottom_px = 0;
  double content_right_px = 0;  ///< floor and labels end here

  /// Of discs: the part of the frame that shows them, in whole pixels. All else is seen from its
  /// upper left corner.
  Rect window = {};

  /// Pixel position of a point of the scene.
  Point at(double x, double y) const noexcept {
    return {origin.x + x * scale, origin.y - y * scale};
  }
  Point at(const std::array<double, 2>& place) const noexcept { return at(place[0], place[1]); }
  double width_px(std::size_t body) const noexcept { return shapes[body].width * scale; }
  double height_px(std::size_t body) const noexcept { return shapes[body].height_px; }
  /// A block on the floor.
  Rect at(std::size_t body, const FrameState& shown) const noexcept {
    return block_at(body, shown.state.bodies[body].position[0]);
  }
  Rect block_at(std::size_t body, double position) const noexcept {
    const BlockShape& block = shapes[body];
    return {origin.x + (position - block.width / 2) * scale, floor_px - block.height_px,
            block.width * scale, block.height_px};
  }
  double top_px() const noexcept {
    return floor_px - std::ranges::max_element(shapes, {}, &BlockShape::height_px)->height_px;
  }
};

/// What a layout is made from. It does not outlive the making.
struct LayoutContext {
  const Scene& scene;
  const Log& log;
  const Palette& palette;
  const std::vector<BlockColors>& colors;  ///< of each body
  const Fonts& fonts;
  const Font& font;  ///< of plain text
  const Sizes& sizes;

  /// Of two blocks beside a wall, for what is drawn for them alone.
  const PairLog& two_blocks() const { return *pair(); }
  /// Nothing where the scene has other bodies.
  const PairLog* pair() const { return log.pair(); }
  bool is_plane() const noexcept { return scene.system.dimensions == 2; }
  bool shows_hits() const noexcept { return scene.show.hits && scene.view.theme != Theme::article; }
  FormulaSetter setter() const { return {fonts, font.face()}; }
};

/// What overlays and panels are drawn from.
struct DrawingContext : LayoutContext {
  const Layout& layout;
};

/// Where the counter and the digits of pi are. Both end at the right margin.
struct CounterPlace {
  double right_px = 0;
  double baseline_px = 0;
  double size_px = 0;            ///< of the count's type
  double room_px = 0;            ///< the longest count's width
  bool has_label = true;         ///< else there is room for the count alone
  double label_baseline_px = 0;  ///< the count's, or above it at the right end
  bool has_pi = false;           ///< the line below has room
  double pi_baseline_px = 0;     ///< of that line
  Point slow_motion;             ///< right end of its label's baseline
  double pi_row_left_px = 0;     ///< left end of that label and of the digits of pi
};

/// Where positions on the axis of a line are in the frame.
struct AxisPlace {
  double origin_px = 0;         ///< of position 0
  double scale = 1;             ///< pixels per unit
  double visible_right_px = 0;  ///< blocks are seen up to here
};

struct FramePlan {
  std::vector<TextItem> lines;  ///< title and caption
  CounterPlace counter;
  Rect logo;  ///< empty unless asked for
  Rect stage;
  AxisPlace axis;                   ///< of a line, unless its picture is the article's
  bool is_floor_at_bottom = false;  ///< all spare height of the stage is above the blocks
  double header_bottom_px = 0;      ///< lower end of title, counter and digits of pi
  double read_outs_top_px = 0;
  std::vector<Rect> panels;
};

/// What the counter needs room for.
struct CounterRoom {
  double count_em = 0;        ///< width of the longest count that is shown
  double label_px = 0;        ///< width of what is before it
  double pi_px = 0;           ///< width of the line of digits below it; 0 if there is none
  double slow_motion_px = 0;  ///< width of its label; 0 if it is among the read-outs
};

/// @throws UsageError if a line cannot be set or is too long, or something gets too small.
/// @param counter  nothing where the stage has it
FramePlan plan_frame(const LayoutContext& context, const std::optional<CounterRoom>& counter,
                     double read_outs_height_px);

/// Least side of a diagram, in ems.
inline constexpr double kLeastPanel_em = 6;

/// The grid in which `count` panels come out largest, if possible not too small.
/// @param gap, em  between panels, and of their text, in pixels
std::vector<Rect> panel_grid(std::size_t count, const Rect& area, double gap, double em);

/// The axis of a line on a stage that begins at the left edge, however high it is.
/// @throws UsageError if the view is beyond a wall, or too close to tell positions.
AxisPlace place_axis(const LayoutContext& context, double stage_width_px);

/// How far to the right blocks and what is above them come while the film lasts, in pixels;
/// infinite where that is not known beforehand.
double reach_px(const LayoutContext& context, const AxisPlace& axis);

/// The places of the stage: of blocks on a line, or of discs in a plane.
/// @throws UsageError if the stage is too low for the bodies, or positions in a plane cannot be
///         told.
Layout lay_out_stage(const LayoutContext& context, const FramePlan& plan);
/// The same of the article's picture. @param longest_count  of those that will be shown
Layout lay_out_article(const LayoutContext& context, const Integer& longest_count,
                       const Rect& area);

/// @throws UsageError if positions along a range of the view, which are doubles, would be drawn in
///         wrong places. @param key  of the range
void check_resolution(const Range& range, const char* key, double scale);

/// What is the same in every frame.
inline Drawable unchanging(std::vector<DrawItem> same) {
  return {[same = std::move(same)](const FrameState& /*shown*/, std::vector<DrawItem>& items) {
    items.insert(items.end(), same.begin(), same.end());
  }};
}

/// The sum of mass · velocity² of all movable bodies at time 0.
Rational twice_energy(const System& system);
/// The same sum in a state. It may be beyond the range of a double.
/// @param masses  masses_or_zero()
mpf_class twice_energy(const std::vector<mpf_class>& masses, const State& state);
/// The mass of each body; 0 for an immovable one.
std::vector<mpf_class> masses_or_zero(const System& system);
/// The largest in a film. If something is driven, only some instants are tried.
Rational most_twice_energy(const Scene& scene, const Log& log);
/// Of all movable bodies; 0 if there is none.
Rational heaviest_mass(const System& system);

}  // namespace piblocks
