// Which place of the frame each thing gets, and what it is drawn from.
// In: a scene and its collision log. Out: places that do not overlap, for any shape of frame.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "draw/font.hpp"
#include "draw/look.hpp"

namespace piblocks {

/// The stage: the map from scene to pixels, sizes of type and lines. It depends on the area and on
/// the longest count alone, so that nothing shifts while the counter grows.
struct Layout {
  double scale = 1;  ///< pixels per unit of the scene
  Point origin;      ///< pixel position of the scene's (0, 0)
  int frame_px = 0;  ///< width of the frame
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

/// What overlays and panels are drawn from. It does not outlive their making.
struct DrawingContext {
  const Scene& scene;
  const CollisionLog& log;
  const Palette& palette;
  const Font& font;
  const Layout& layout;
  double text_px;  ///< of what is read beside the blocks
  double line_px;
  FrameNeeds& needs;  ///< a drawable says here what it reads of a FrameState
};

struct FramePlan {
  std::optional<TextItem> title;
  std::optional<TextItem> caption;
  Rectangle logo;  ///< empty unless asked for
  Rectangle stage;
  std::vector<Rectangle> panels;
};

/// @param context       its layout is not read.
/// @param read_outs_px  height of their rows, which are below the stage
/// @throws UsageError if a line cannot be set or is too long, or something gets too small.
FramePlan plan_frame(const DrawingContext& context, double read_outs_px);

/// @param longest_count  of those that will be shown
/// @throws UsageError if the view is so close that doubles cannot hold the positions.
Layout lay_out(const Scene& scene, const Integer& longest_count, const Rectangle& area,
               const Font& font);

/// The blocks while the picture is exposed. @param red, blue  at its instant, without dwells
ExposedItem exposed_item(ExposedBlock red, ExposedBlock blue, const Layout& layout,
                         std::span<const WeightedExposure> exposures);

/// What is the same in every frame.
inline Drawable unchanging(std::vector<DrawItem> same) {
  return [same = std::move(same)](const FrameState& /*shown*/, std::vector<DrawItem>& items) {
    items.insert(items.end(), same.begin(), same.end());
  };
}

/// The height on which both blocks stand, in units of the scene. The larger one's middle is at 0.
double base_of(const BlockSystem& system);

/// The sum of both blocks' mass · velocity², which never changes.
Rational twice_energy(const BlockSystem& system);

}  // namespace piblocks
