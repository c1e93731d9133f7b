// What is written in the diagram of velocities, and where there is room for it.
// In: the circle in its panel, and points on it. Out: labels, and the arc that one of them names.
#pragma once

#include <vector>

#include "draw/panels/panels.hpp"
#include "draw/panels/velocity_points.hpp"

namespace piblocks {

/// What a label is true of. Arcs are equal on the circle alone.
enum class VelocityPart { ellipse, circle, arcs, end };

struct VelocityLabel {
  Formula formula;
  Point at;  ///< left end of the baseline
  Color color;
  VelocityPart part = VelocityPart::circle;
};

struct VelocityLabels {
  std::vector<VelocityLabel> labels;
  std::vector<Point> arc;    ///< outside of the circle, from one point to the next; may be empty
  std::size_t arc_from = 0;  ///< collisions after which both points have been reached
};

/// The circle and its room, in pixels.
struct VelocityPlace {
  Rect inside;
  Circle circle;
  double em = 0;
};

/// The circle as large as the names of its axes allow, and together with the words beside it in the
/// middle of a wide panel.
VelocityPlace place_velocities(const Diagram& diagram, const FormulaSetter& set);

/// The greatest ratio of the axes that is drawn. A longer ellipse is drawn with this ratio.
inline constexpr long kMostLongEllipse = 12;

/// Labels: the names of the axes, "no more hits here", the marked arc's name, and the ellipse's
/// explanation. Labels without room are left out.
/// @param angles  of all points, if they can be told apart; else none
VelocityLabels label_velocities(const DrawingContext& context, const VelocityPlace& place,
                                const VelocityPoints& points, const std::vector<double>& angles);

}  // namespace piblocks
