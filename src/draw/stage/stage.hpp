// The stage: bodies and their walls, and what is written and drawn on them.
// In: a drawing context with its layout. Out: drawables, and what the loupe is made of too.
#pragma once

#include <piblocks/image.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

/// Greatest distance of neighbouring doubles on the axis.
inline constexpr double kMostStep_px = 0.25;
/// Of the stage, in fractions of the frame's shorter side.
inline constexpr double kLeastHeight = 0.05;
inline constexpr double kWallAbove = 0.03;  ///< of the tallest block

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

/// Where the walls of a line are, if there are any.
struct LineWalls {
  std::optional<Rational> left;
  std::optional<Rational> right;
};
/// The blocks of a line in their order, which never changes.
std::vector<std::size_t> from_left_to_right(const System& line);
LineWalls line_walls(const System& system);
/// Those of them whose face is in the view.
LineWalls seen_walls(const System& system, const View& view);
/// What is seen of the axis of a line: nothing is drawn behind a wall's face.
Range seen_axis(const System& system, const View& view);

/// From one column of pixels to another.
struct Columns {
  double left = 0;
  double right = 0;
  double width() const { return right - left; }
};
/// Where texts about a line may be.
Columns text_columns(const DrawingContext& context);
/// The part of text_columns() between the walls, a little apart from their faces.
Columns text_columns_between_walls(const DrawingContext& context);

/// The bodies, and what hides those that leave a row.
Drawable bodies(const DrawingContext& context);

/// The article's picture of a line: blocks and counter.
/// @param lit_digits  light up when the counter shows them in their places; may be empty
Drawable article_blocks(const DrawingContext& context, std::string lit_digits);

/// A body at the picture's instant. @see MovingShape
struct PlacedBody {
  ItemId id;
  std::size_t body = 0;  ///< its number
  std::variant<ExposedBlock, DiscItem> still;
};

/// Adds the bodies that stay, and one item of all others.
/// @param bodies     in the order in which they are painted
/// @param exposures  none if the picture is that of its instant
void add_exposed(std::span<const PlacedBody> bodies, const Layout& map, const PixelRect& frame,
                 std::span<const WeightedExposure> exposures, std::vector<DrawItem>& items);

/// The two blocks of a closed form while the picture is exposed, as seen from their wall.
/// @param red, blue  at its instant, without dwells
ExposedBlocksItem exposed_blocks(ExposedBlock red, ExposedBlock blue, const AxisPlace& axis,
                                 std::span<const WeightedExposure> exposures);

/// Adds all blocks as they are at the frame's instant, or exposed.
void add_blocks(const FrameState& shown, const Layout& layout,
                const std::vector<BlockColors>& colors, std::vector<DrawItem>& items);

/// Whether the scene shows masses, by itself or by its theme.
bool has_masses(const Scene& scene);
/// The label of each body, or its mass if the scene shows masses: on the body; or above it, if it
/// is a block that is heavier and no lower than its neighbours, or a disc; else below the floor.
/// @throws UsageError if one has no room.
Drawable body_labels(const DrawingContext& context);
/// Whether the scene shows any label or mass.
bool has_labels(const LayoutContext& context);
/// The blocks whose labels are above them, or below the floor.
std::vector<std::size_t> labelled_above(const LayoutContext& context, const Layout& layout);
std::vector<std::size_t> labelled_below(const LayoutContext& context, const Layout& layout);
/// Room that a label needs above its block, in pixels.
double label_room_px(const Sizes& sizes);
double label_room_below_px(const Sizes& sizes);

/// Arrows above blocks, with figures where there is room for all of them. Velocities of one run
/// differ by the square root of the mass ratio, so lengths grow less and less with the velocity, up
/// to a longest one. Arrows of discs begin at their edge, and are as long as they are fast.
/// @throws UsageError if the view has no room above the blocks.
Drawable velocity_arrows(const DrawingContext& context);

/// Tail and tip of the arrow above a block, one of so many, in a picture; nothing without it.
std::optional<std::array<Point, 2>> arrow_in(const DrawList& list, std::size_t block,
                                             std::size_t count);

/// How long these arrows are.
class ArrowLengths {
 public:
  ArrowLengths(const Scene& scene, const Log& log, const Layout& layout);

  /// Negative to the left.
  double length_px(double velocity) const;
  double longest_px() const noexcept { return longest_px_; }
  /// Near 0, an arrow grows by so many pixels per unit of velocity; 0 where nothing moves.
  double px_per_speed() const;

 private:
  mpf_class usual_speed_ = 0;
  double longest_px_ = 0;
};

/// Room that the scene's overlays need above the tallest block, in pixels.
double room_above_px(const LayoutContext& context, const Layout& layout);
/// The same below the floor.
double room_below_px(const LayoutContext& context, const Layout& layout);

/// Strokes at 45 degrees behind a face, in fractions of the frame's shorter side.
struct Hatch {
  double width;
  double step;  ///< along the face
};
inline constexpr Hatch kWallHatch = {style::kWallWidth, 0.02};
inline constexpr Hatch kFloorHatch = {0.013, 0.03};

/// A hatched wall or floor, its face from one place to the other, with the bodies on the left of
/// this way.
/// @param beyond_px  how far the face's line is longer at both ends
std::vector<DrawItem> hatched_face(const Point& from, const Point& to, const Palette& palette,
                                   const Sizes& sizes, const Hatch& hatch, double beyond_px = 0);

/// The walls of a layout, and the floor of a line.
std::vector<DrawItem> stage_walls(const DrawingContext& context);
/// Walls that move; nothing if there are none.
std::optional<Drawable> moving_walls(const DrawingContext& context);
/// Those of the article's picture: bodies of width 1 whose faces are where blocks turn back.
std::vector<DrawItem> article_walls(const DrawingContext& context);
/// One of them. @param side  1 if blocks are on its right, -1 if on its left
PathItem article_wall(const Layout& layout, const View& view, const Color& color, double face,
                      int side);

/// A block with the lines and corners of a layout, in the colours and with the bars of the theme.
ExposedBlock block_at(const Rect& bounds, const BlockColors& colors, const Layout& layout);

/// Items that never change. @param bounds  around them; they become whole pixels
PlateItem plate_of(ItemId id, const Rect& bounds, std::vector<DrawItem> items);

}  // namespace piblocks
