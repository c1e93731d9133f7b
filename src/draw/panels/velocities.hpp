// Velocities as points of a circle, and what is written beside it where there is room.
// In: a scene, its log, the circle in its panel. Out: points, labels, the arc that one of them
// names.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <vector>

#include "draw/panels/panels.hpp"

namespace piblocks {

/// The point (sqrt(m_red) v_red, sqrt(m_blue) v_blue) over the square root of twice the energy is
/// on the circle of radius 1. A collision with the wall mirrors it in the horizontal axis, one of
/// the blocks in the direction of the wedge angle. Angles are counter-clockwise, from the right.
class VelocityPoints {
 public:
  VelocityPoints(const Scene& scene, const PairLog& log);

  /// If neither block moves, all points are 0.
  bool moves() const noexcept { return moves_; }
  double wedge_angle() const noexcept { return wedge_angle_; }
  /// Collisions before() + 1 to last() are shown: those of the scene.
  const Integer& before() const noexcept { return before_; }
  const Integer& last() const noexcept { return last_; }
  /// Before the first of them.
  double start_angle() const noexcept { return start_angle_; }

  /// y is up.
  Point point_of(double blue_velocity, double red_velocity) const {
    return {mpf_class(red_factor_ * red_velocity).get_d(),
            mpf_class(blue_factor_ * blue_velocity).get_d()};
  }
  CollisionKind kind_of(const Integer& collision) const {
    const Integer later = collision - before_ - 1;
    const bool is_first_kind = mpz_even_p(later.get_mpz_t()) != 0;
    return (first_ == CollisionKind::wall) == is_first_kind ? CollisionKind::wall
                                                            : CollisionKind::blocks;
  }
  double reflected(double angle, CollisionKind kind) const {
    return kind == CollisionKind::wall ? -angle : 2 * wedge_angle_ - angle;
  }
  /// Before the first collision and after each one. For few collisions.
  std::vector<double> all_angles() const;

 private:
  double wedge_angle_;
  bool moves_ = false;
  // From a velocity to its part of the radius; they may be beyond the range of a double.
  mpf_class red_factor_;
  mpf_class blue_factor_;
  Integer before_ = 0;
  Integer last_;
  CollisionKind first_ = CollisionKind::blocks;
  double start_angle_ = 0;
};

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

/// The mass ratio for which the ellipse is drawn: red's mass to blue's, within limits.
Rational drawn_mass_ratio(const TwoBlocks& system);

/// Labels: the names of the axes, "no more hits here", the marked arc's name, and the ellipse's
/// explanation. Labels without room are left out.
/// @param angles  of all points, if they can be told apart; else none
VelocityLabels label_velocities(const DrawingContext& context, const VelocityPlace& place,
                                const VelocityPoints& points, const std::vector<double>& angles);

}  // namespace piblocks
