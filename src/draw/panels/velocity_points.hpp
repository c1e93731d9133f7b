// Velocities as points of a circle, and where each collision moves them.
// In: a scene and its log. Out: points, angles and kinds of collisions.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <vector>

#include "draw/draw_list.hpp"
#include "draw/number_text.hpp"

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

}  // namespace piblocks
