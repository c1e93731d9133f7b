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
#include "draw/theme.hpp"

namespace piblocks {

/// The map from scene to pixels, sizes of type and lines: all that does not move. It depends on the
/// area's size and on the longest count alone, so that nothing shifts while the counter grows.
struct Layout {
  double scale = 1;  ///< pixels per unit of the scene
  Point origin;      ///< pixel position of the scene's (0, 0)
  double line_px = 1;
  double text_px = 16;
  Point label;              ///< baseline of "Collisions: "
  double label_em = 0;      ///< from there to where the count starts
  double count_em = 0;      ///< width of the longest count
  double line_left_px = 0;  ///< label and count begin here or to the right
  double line_room_px = 0;  ///< and are no longer than this together
  double above_px = 0;      ///< half of the room between label and view
  double below_px = 0;      ///< room from the view to the area's end

  /// Pixel position of a point of the scene.
  Point at(double x, double y) const noexcept {
    return {origin.x + x * scale, origin.y - y * scale};
  }
  /// The same of a rectangle, from its lower left corner.
  Rectangle at(double x, double y, double width, double height) const noexcept {
    return {origin.x + x * scale, origin.y - (y + height) * scale, width * scale, height * scale};
  }
};

/// What all things in a picture are made from. It does not outlive their making.
struct Setting {
  const Scene& scene;
  const CollisionLog& log;
  const Palette& palette;
  const Font& font;
  const Layout& stage;
  double text_px;  ///< of what is read beside the blocks
  double line_px;
};

/// The height on which both blocks stand, in units of the scene: the middle of the larger one is
/// at 0.
double base_of(const BlockSystem& system);

/// The sum of both blocks' mass · velocity², which never changes.
Rational twice_energy(const BlockSystem& system);

/// @param longest_count  of those that will be shown
/// @throws UsageError if the view is so close that doubles cannot hold the positions.
Layout lay_out(const Scene& scene, const Integer& longest_count, const Rectangle& area,
               const Font& font);

class StagePicture {
 public:
  /// @param lit_digits  digits that light up when the counter shows them in their places; may be
  ///                    empty
  StagePicture(const Setting& setting, std::string lit_digits);

  /// @param exposure  as in Composition::frame().
  void add(const BlockState& state, std::span<const WeightedExposure> exposure,
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
