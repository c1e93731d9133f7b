// Smooth balls in any number of dimensions: the bodies of the event-driven engine.
// In: two balls in free flight. Out: when they touch, and how they fly on.
// Templates over Eigen vectors; Scalar is double, long double or a Boost.Multiprecision float.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

namespace piblocks {

/// The mass of a wall: a body with it is never deflected. It may move.
template <typename Scalar>
inline const Scalar kInfiniteMass = std::numeric_limits<Scalar>::infinity();

/// A ball in free flight (in one dimension a block: an interval). Units are the caller's own.
template <typename Scalar, int Dim>
struct Particle {
  static_assert(Dim >= 1, "a particle needs a space of fixed dimension");
  using Vector = Eigen::Matrix<Scalar, Dim, 1>;

  Scalar mass = Scalar(1);           ///< > 0; may be kInfiniteMass
  Scalar radius = Scalar(1);         ///< > 0, finite; half the width of a block
  Vector position = Vector::Zero();  ///< of the centre, finite
  Vector velocity = Vector::Zero();  ///< finite

  bool is_immovable() const { return mass == kInfiniteMass<Scalar>; }
};

namespace detail {

/// Euclidean length of v. Scaled by the largest coefficient, so that squares neither overflow nor
/// underflow; exact in one dimension.
template <typename Scalar, int Dim>
Scalar length(const Eigen::Matrix<Scalar, Dim, 1>& v) {
  const Scalar largest = v.cwiseAbs().maxCoeff();
  if (largest == 0) return Scalar(0);
  return Scalar(largest * Eigen::Matrix<Scalar, Dim, 1>(v / largest).norm());
}

/// v / length(v), scaled likewise; NaN for the zero vector.
template <typename Scalar, int Dim>
Eigen::Matrix<Scalar, Dim, 1> direction(const Eigen::Matrix<Scalar, Dim, 1>& v) {
  const Eigen::Matrix<Scalar, Dim, 1> scaled = v / v.cwiseAbs().maxCoeff();
  return scaled / scaled.norm();
}

/// other / (own + other), the part of a collision's velocity change that falls to the body with
/// mass `own`. At most one mass is infinite.
template <typename Scalar>
Scalar share_of_change(const Scalar& own, const Scalar& other) {
  using std::isinf;
  const Scalar sum = own + other;
  // This quotient saturates at 0 and infinity where it should, but rounds once more.
  if (isinf(sum)) return Scalar(Scalar(1) / (Scalar(1) + own / other));
  return Scalar(other / sum);
}

}  // namespace detail

/// Moves a ball along its straight line for a time dt of either sign.
template <typename Scalar, int Dim>
void advance(Particle<Scalar, Dim>& particle, const std::type_identity_t<Scalar>& dt) {
  particle.position += dt * particle.velocity;
}

/// The time from now until two balls that approach each other touch; 0 if they touch or overlap
/// already. None if they recede, keep their distance, pass by or merely graze, or if both are
/// immovable. NaN or infinite if the numbers leave Scalar's range.
///
/// With x, v the relative position and velocity and R the sum of the radii, |x + v t| = R is the
/// separation quadratic. Its first root is (along - half_chord) / |v|, where `along` is the way to
/// the closest approach, `miss` the distance there and half_chord^2 = R^2 - miss^2. Two
/// subtractions of nearly equal numbers are avoided: the discriminant is taken from the miss
/// vector and as a product, (R - miss)(R + miss); and the root as the quotient of the product of
/// both roots, (|x| - R)(|x| + R), by the larger one (Press et al., Numerical Recipes, 5.6).
template <typename Scalar, int Dim>
std::optional<Scalar> collision_time(const Particle<Scalar, Dim>& p,
                                     const Particle<Scalar, Dim>& q) {
  using std::sqrt;
  using Vector = typename Particle<Scalar, Dim>::Vector;
  if (p.is_immovable() && q.is_immovable()) return std::nullopt;
  if (p.velocity == q.velocity) return std::nullopt;

  const Vector x = q.position - p.position;
  const Vector v = q.velocity - p.velocity;
  const Vector course = detail::direction(v);
  const Scalar along = -x.dot(course);
  if (along <= 0) return std::nullopt;

  const Scalar reach = p.radius + q.radius;
  const Scalar distance = detail::length(x);
  if (distance <= reach) return Scalar(0);

  const Scalar miss = detail::length(Vector(x + along * course));
  if (miss >= reach) return std::nullopt;

  // Quotients of like lengths keep every intermediate in range, and make a head-on meeting (the
  // only one in one dimension) exactly (distance - reach) / speed.
  const Scalar half_chord = (reach + miss) * sqrt(Scalar((reach - miss) / (reach + miss)));
  const Scalar slant = (distance + reach) / (along + half_chord);
  return Scalar((distance - reach) / detail::length(v) * slant);
}

/// Gives two touching balls the velocities they have after an elastic collision without friction:
/// momentum and energy are conserved, and only the velocities along the line of centres change,
///   u_p' = u_p - 2 m_q / (m_p + m_q) (u_p - u_q),   u_q' likewise
/// (Landau & Lifshitz, Mechanics, section 17). Nothing happens unless the balls approach.
/// At most one may be immovable; the centres must not coincide, or velocities become NaN.
template <typename Scalar, int Dim>
void collide(Particle<Scalar, Dim>& p, Particle<Scalar, Dim>& q) {
  using Vector = typename Particle<Scalar, Dim>::Vector;
  const Vector normal = detail::direction(Vector(q.position - p.position));
  const Scalar closing_speed = (p.velocity - q.velocity).dot(normal);
  // Rounding can leave a grazing pair receding at contact; an impulse would pull it together.
  if (closing_speed <= 0) return;
  const Scalar change = Scalar(2) * closing_speed;
  p.velocity -= Scalar(change * detail::share_of_change(p.mass, q.mass)) * normal;
  q.velocity += Scalar(change * detail::share_of_change(q.mass, p.mass)) * normal;
}

}  // namespace piblocks
