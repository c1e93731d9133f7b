// What to draw: the article's picture of one state.
// In: a view, once, and a state, for every frame. Out: a draw list.
#pragma once

#include <piblocks/draw_list.hpp>
#include <piblocks/exposure.hpp>
#include <piblocks/interpolator.hpp>
#include <piblocks/scene.hpp>

#include <memory>
#include <span>

namespace piblocks {

/// Where everything is that does not move: the map from scene to pixels, sizes of type and
/// lines. They depend on the frame's size and on the longest count alone, so that nothing
/// shifts while the counter grows.
struct Layout {
  int width_px = 0;
  int height_px = 0;
  double scale = 1;  ///< pixels per unit of the scene
  Point origin;      ///< pixel position of the scene's (0, 0)
  double line_px = 1;
  double text_px = 16;
  Point label;         ///< baseline of "Collisions: "
  double count_x = 0;  ///< where the count starts on that baseline
};

/// @param longest_count  the last count that will be shown.
/// @throws DrawError if the font cannot be loaded.
Layout lay_out(const Scene& scene, const Integer& longest_count);

/// The frame that shows `state`.
DrawList compose(const Scene& scene, const Layout& layout, const BlockState& state);

/// A part of the time for which a frame is exposed.
struct ExposurePart {
  double share = 1;  ///< of that time; 1 in all
  std::unique_ptr<Exposure> exposure;
};

/// The frame that shows where the blocks are during `parts`, and what else there is at `state`.
/// @param parts  at least one.
DrawList compose(const Scene& scene, const Layout& layout, const BlockState& state,
                 std::span<const ExposurePart> parts);

}  // namespace piblocks
