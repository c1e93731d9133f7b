// The article's picture: wall, blocks and counter.
// In: a scene and the part of the frame it may take, once; a state, for every frame. Out: items.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <span>
#include <string>
#include <vector>

#include "draw/composition.hpp"
#include "draw/draw_list.hpp"
#include "draw/font.hpp"
#include "draw/text_widths.hpp"
#include "draw/theme.hpp"

namespace piblocks {

/// Where everything is that does not move: the map from scene to pixels, sizes of type and
/// lines. They depend on the area's size and on the longest count alone, so that nothing
/// shifts while the counter grows.
struct Layout {
  double scale = 1;  ///< pixels per unit of the scene
  Point origin;      ///< pixel position of the scene's (0, 0)
  double line_px = 1;
  double text_px = 16;
  Point label;              ///< baseline of "Collisions: "
  double label_em = 0;      ///< from there to where the count starts
  double count_em = 0;      ///< width of the longest count
  double line_left_px = 0;  ///< where label and count may begin at most
  double line_room_px = 0;  ///< and how long they may be together
  double above_px = 0;      ///< room between label and view, half of it
  double below_px = 0;      ///< room from the view to the area's end

  /// Pixel position of a point of the scene.
  Point at(double x, double y) const noexcept {
    return {origin.x + x * scale, origin.y - y * scale};
  }
  double count_x() const noexcept { return label.x + label_em * text_px; }
};

/// The length that type and lines are measured by: the area's height, or less where the area is
/// narrow.
double short_measure(const Rectangle& area);
/// Where the height is less than this part of the width, it is the height that counts.
inline constexpr double kNarrow = 0.75;

/// What all lines of a frame are measured by: a part of its short measure, wherever in it they are.
/// Lines of the blocks are as many whole pixels, so that their edges are sharp.
double line_width_px(const View& view);

/// The height on which both blocks stand, in units of the scene: the middle of the larger one is
/// at 0.
double base_of(const BlockSystem& system);

/// @param longest_count  of those that will be shown.
/// @throws UsageError if the view is closer up than positions are known.
Layout lay_out(const Scene& scene, const Integer& longest_count, const Rectangle& area,
               const Font& font);

class StagePicture {
 public:
  /// @param lit_digits  digits that light up in the counter as soon as it shows them in their
  ///                    places; none if empty.
  StagePicture(const Scene& scene, const Layout& layout, const Palette& palette, const Font& font,
               std::string lit_digits);

  /// @param exposure  as in Composition::frame().
  void add(const BlockState& state, std::span<const ExposurePart> exposure,
           std::vector<DrawItem>& items) const;

 private:
  ExposedBlock block(double side, const Motion& motion, const BlockColors& colors) const;
  void add_line(const Integer& count, std::vector<DrawItem>& items) const;

  Layout layout_;
  Palette palette_;
  int width_px_;
  RectangleItem wall_;
  double base_;
  double blue_side_;
  double red_side_;
  std::string lit_digits_;
  TextWidths widths_;
};

}  // namespace piblocks
