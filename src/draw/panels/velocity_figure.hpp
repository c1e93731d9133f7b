// The diagram of velocities without its chords: axes and their names, the curve, an arc, the end.
// In: a diagram and points. Out: a map from points to pixels, and items.
#pragma once

#include <array>
#include <vector>

#include "core/rounded.hpp"
#include "draw/panels/velocity_labels.hpp"
#include "draw/panels/velocity_points.hpp"

namespace piblocks {

/// From angles of the circle to places on it, or on the ellipse that it is before velocities are
/// scaled by the roots of the masses.
struct VelocityMap {
  Point centre;
  // Semi-axes in pixels.
  double red = 0;
  double blue = 0;

  Point at(double angle) const {
    const auto [sine, cosine] = rounded::sin_cos(angle);
    return at(Point{cosine, sine});
  }
  Point at(const Point& unit) const { return {centre.x + red * unit.x, centre.y - blue * unit.y}; }
};

class VelocityFigure {
 public:
  /// @param context, diagram  not kept
  VelocityFigure(const DrawingContext& context, const Diagram& diagram, VelocityPoints points);

  /// @param share  of the way from the ellipse, 0, to the circle, 1; the map that multiplies each
  ///               velocity by its mass to the power of share / 2
  VelocityMap map(double share) const;
  /// Whether chords are so far apart that each is drawn.
  bool has_chords() const noexcept { return has_chords_; }
  /// As all_angles(); none unless has_chords().
  const std::vector<double>& angles() const noexcept { return angles_; }
  double dot_px() const noexcept { return dot_px_; }

  /// What is always there, from back to front. @param first  the first of their ids
  std::vector<DrawItem> items(double share, ItemId first) const;
  /// What arc_from() collisions have cut off.
  std::vector<DrawItem> arc_items(double share, ItemId first) const;
  std::size_t arc_from() const noexcept { return written_.arc_from; }
  /// The velocities after which nothing collides.
  std::vector<DrawItem> end_items(double share, ItemId first) const;
  /// Both axes, through the centre.
  std::array<std::vector<Point>, 2> axes() const;

 private:
  void add_labels(VelocityPart part, double share, ItemId first,
                  std::vector<DrawItem>& items) const;

  VelocityPoints points_;
  Palette palette_;
  double grid_px_;
  double log_axes_;  ///< of the ellipse's drawn semi-axes, blue over red
  VelocityPlace place_;
  bool has_chords_ = false;
  double dot_px_ = 0;
  std::vector<double> angles_;
  VelocityLabels written_;
};

}  // namespace piblocks
