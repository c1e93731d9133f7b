// The general engine: any number of balls in any dimension, from collision to collision.
// In: particles at time 0, walls among them. Out: the collisions in order.
// Between collisions every particle flies straight, so nothing is stepped and nothing is missed.
// Scalar is double, long double or a Boost.Multiprecision float.
#pragma once

#include <piblocks/contact.hpp>
#include <piblocks/error.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace piblocks {

/// A ball in free flight (in one dimension a block: an interval), or a wall. Units are the caller's
/// own.
template <typename Scalar, int Dim>
struct Particle {
  static_assert(Dim >= 1, "a particle needs a space of fixed dimension");
  using Vector = Eigen::Matrix<Scalar, Dim, 1>;

  Scalar mass = Scalar(1);    ///< > 0; may be kInfiniteMass
  Scalar radius = Scalar(1);  ///< > 0, finite; half the width of a block
  // GCC 12 breaks down at Vector::Zero() where an initialiser leaves out a member.
  Vector position = Vector::Constant(Scalar(0));  ///< of the centre, finite
  Vector velocity = Vector::Constant(Scalar(0));  ///< finite
  /// Not 0: it is a wall through `position` that faces this way, of any length; its mass must be
  /// infinite, and its radius has no meaning.
  Vector facing = Vector::Constant(Scalar(0));

  bool is_wall() const { return facing != Vector::Zero(); }
  bool is_immovable() const { return mass == kInfiniteMass<Scalar>; }
};

namespace detail {

/// The sum of products, in the order of coordinates. Eigen's dot() adds in an order that depends on
/// the vectors of the processor, and so rounds differently.
template <typename Scalar, int Dim>
Scalar dot(const Eigen::Matrix<Scalar, Dim, 1>& a, const Eigen::Matrix<Scalar, Dim, 1>& b) {
  Scalar sum = a[0] * b[0];
  for (int i = 1; i < Dim; ++i) sum += a[i] * b[i];
  return sum;
}

/// The root of the sum of squares.
template <typename Scalar, int Dim>
Scalar norm(const Eigen::Matrix<Scalar, Dim, 1>& v) {
  using std::sqrt;
  return Scalar(sqrt(dot(v, v)));
}

/// Euclidean length of v. Scaled by the largest coefficient, so that squares neither overflow nor
/// underflow; exact in one dimension.
template <typename Scalar, int Dim>
Scalar length(const Eigen::Matrix<Scalar, Dim, 1>& v) {
  const Scalar largest = v.cwiseAbs().maxCoeff();
  if (largest == 0) return Scalar(0);
  return Scalar(largest * norm(Eigen::Matrix<Scalar, Dim, 1>(v / largest)));
}

/// v / length(v), scaled likewise; NaN for the zero vector.
template <typename Scalar, int Dim>
Eigen::Matrix<Scalar, Dim, 1> direction(const Eigen::Matrix<Scalar, Dim, 1>& v) {
  const Eigen::Matrix<Scalar, Dim, 1> scaled = v / v.cwiseAbs().maxCoeff();
  return scaled / norm(scaled);
}

}  // namespace detail

/// @param dt  of either sign.
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

  if (p.is_wall()) return collision_time(q, p);
  const Vector x = q.position - p.position;
  const Vector v = q.velocity - p.velocity;
  if (q.is_wall()) {
    const Vector towards = -detail::direction(q.facing);
    return time_to_contact(Scalar(detail::dot(x, towards) - p.radius),
                           Scalar(-detail::dot(v, towards)));
  }
  const Vector course = detail::direction(v);
  const Scalar along = -detail::dot(x, course);
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
  const Vector normal = p.is_wall()   ? detail::direction(p.facing)
                        : q.is_wall() ? Vector(-detail::direction(q.facing))
                                      : detail::direction(Vector(q.position - p.position));
  const Scalar closing_speed = detail::dot(Vector(p.velocity - q.velocity), normal);
  // Rounding can leave a grazing pair receding at contact; an impulse would pull it together.
  if (closing_speed <= 0) return;
  p.velocity -= velocity_change(closing_speed, share_of_change(p.mass, q.mass)) * normal;
  q.velocity += velocity_change(closing_speed, share_of_change(q.mass, p.mass)) * normal;
}

/// One collision. Together with the particles at time 0, a run's events describe it completely.
template <typename Scalar, int Dim>
struct CollisionEvent {
  std::int64_t index;  ///< from 1
  Scalar time;
  std::size_t first;                   ///< index of a particle, < second
  std::size_t second;                  ///< index of the other
  Particle<Scalar, Dim> first_after;   ///< just after the collision
  Particle<Scalar, Dim> second_after;  ///< just after the collision
};

/// Advances particles from one pair collision to the next.
///
/// Of several collisions at the same time the one that comes first by TieRank is performed first. A
/// corner hit thus begins with the blocks, which is the limit that counts the digits of pi.
///
/// A pair that has collided does not collide again before one of the two has met another body: two
/// free balls separate for ever. The rule also holds against rounding, so no pair can trap the run.
///
/// A step costs 2 N evaluations of collision_time() and about N^2 / 2 comparisons. Positions are
/// absolute and time is a plain sum: double counts the article's system right up to nine digits,
/// and its blue block is within 1e-5 of the truth up to eight. Not thread-safe while stepping;
/// const members are.
template <typename Scalar, int Dim>
class EventSimulator {
 public:
  using Body = Particle<Scalar, Dim>;
  using Event = CollisionEvent<Scalar, Dim>;

  /// @throws UsageError, one line for each particle and property, if a mass or radius is not
  ///         positive or a radius, position or velocity not finite.
  /// @throws SimulationError if differences of the numbers leave Scalar's range.
  explicit EventSimulator(std::vector<Body> particles)
      : particles_(std::move(particles)), waiting_(particles_.size() * particles_.size()) {
    validate();
    prepare();
  }

  /// The particles at time(): at the start, then just after the last collision.
  const std::vector<Body>& particles() const { return particles_; }
  const Scalar& time() const { return time_; }
  std::int64_t count() const { return count_; }  ///< collisions so far

  /// When the next collision is due; none if there will be no more.
  std::optional<Scalar> next_time() const {
    if (!next_) return std::nullopt;
    return Scalar(time_ + *waiting_[slot(next_->first, next_->second)]);
  }

  /// Performs the next collision; none if there will be no more.
  /// @throws SimulationError naming the collision if a number leaves Scalar's range; the
  ///         simulator must not be used any further then.
  std::optional<Event> step() {
    if (!next_) return std::nullopt;
    const auto [first, second] = *next_;
    ++count_;
    elapse(Scalar(*waiting_[slot(first, second)]));
    collide(particles_[first], particles_[second]);
    require_finite();
    waiting_[slot(first, second)].reset();
    for (std::size_t other = 0; other < particles_.size(); ++other) {
      if (other == first || other == second) continue;
      predict(first, other);
      predict(second, other);
    }
    next_ = soonest_pair();
    return Event{count_, time_, first, second, particles_[first], particles_[second]};
  }

  /// Performs all collisions that are left, at most max_events.
  /// @throws SimulationError if more are left, or as step() does.
  std::vector<Event> run(std::int64_t max_events) {
    std::vector<Event> events;
    while (next_) {
      if (std::ssize(events) >= max_events) {
        throw SimulationError("simulation: collision " + std::to_string(count_ + 1) +
                              ": the limit of " + std::to_string(max_events) + " was reached");
      }
      events.push_back(*step());
    }
    return events;
  }

  /// The particles at a time from time() up to the next collision, not performed yet.
  /// @throws UsageError if t lies outside.
  std::vector<Body> particles_at(const Scalar& t) const {
    const std::optional<Scalar> end = next_time();
    if (!(t >= time_) || (end && t > *end)) {
      throw UsageError("simulation: the time asked for is not in the flight after collision " +
                       std::to_string(count_));
    }
    std::vector<Body> moved = particles_;
    for (Body& body : moved) advance(body, Scalar(t - time_));
    return moved;
  }

 private:
  using Pair = std::pair<std::size_t, std::size_t>;

  std::size_t slot(std::size_t i, std::size_t j) const {
    return i < j ? i * particles_.size() + j : j * particles_.size() + i;
  }

  /// Lists all pairs that can collide, in the order in which simultaneous collisions happen, and
  /// finds the first.
  void prepare() {
    const auto rank_of = [this](const Pair& pair) {
      return TieRank::of(
          static_cast<std::uint32_t>(pair.first), !particles_[pair.first].is_immovable(),
          static_cast<std::uint32_t>(pair.second), !particles_[pair.second].is_immovable());
    };
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      for (std::size_t j = i + 1; j < particles_.size(); ++j) {
        const bool can_collide = !particles_[i].is_immovable() || !particles_[j].is_immovable();
        if (can_collide) pairs_.emplace_back(i, j);
      }
    }
    std::ranges::sort(pairs_,
                      [&](const Pair& a, const Pair& b) { return rank_of(a) < rank_of(b); });
    for (const auto& [i, j] : pairs_) predict(i, j);
    next_ = soonest_pair();
  }

  std::optional<Pair> soonest_pair() const {
    std::optional<Pair> soonest;
    const Scalar* shortest = nullptr;
    for (const Pair& pair : pairs_) {
      const std::optional<Scalar>& wait = waiting_[slot(pair.first, pair.second)];
      if (!wait || (shortest && !(*wait < *shortest))) continue;
      shortest = &*wait;
      soonest = pair;
    }
    return soonest;
  }

  void elapse(const Scalar& dt) {
    time_ += dt;
    for (Body& body : particles_) advance(body, dt);
    for (std::optional<Scalar>& wait : waiting_) {
      if (wait) *wait -= dt;
    }
  }

  void predict(std::size_t i, std::size_t j) {
    using std::isnan;
    std::optional<Scalar>& wait = waiting_[slot(i, j)];
    wait = collision_time(particles_[i], particles_[j]);
    if (wait && isnan(*wait)) {
      fail("the next meeting of particles " + std::to_string(i) + " and " + std::to_string(j));
    }
  }

  void require_finite() const {
    using std::isfinite;
    if (!isfinite(time_)) fail("its time");
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      if (particles_[i].position.allFinite() && particles_[i].velocity.allFinite()) continue;
      fail("the state of particle " + std::to_string(i));
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw SimulationError("simulation: collision " + std::to_string(count_) + ": " + what +
                          " is out of the number type's range");
  }

  void validate() const {
    using std::isfinite;
    std::vector<std::string> problems;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      const Body& body = particles_[i];
      const std::string name = "simulation: particle " + std::to_string(i) + ": ";
      if (!(body.mass > 0)) problems.push_back(name + "mass is not positive");
      if (body.is_wall() && !body.is_immovable()) {
        problems.push_back(name + "is a wall, and its mass is not infinite");
      }
      if (!(body.radius > 0 && isfinite(body.radius))) {
        problems.push_back(name + "radius is not positive and finite");
      }
      if (!body.position.allFinite()) problems.push_back(name + "position is not finite");
      if (!body.velocity.allFinite()) problems.push_back(name + "velocity is not finite");
      if (!body.facing.allFinite()) problems.push_back(name + "facing is not finite");
    }
    if (!problems.empty()) throw UsageError(std::move(problems));
  }

  std::vector<Body> particles_;
  std::vector<Pair> pairs_;
  // Row-major N x N, upper triangle: the time from time_ until a pair meets. Counting down keeps
  // the digits that absolute times would lose once they are large.
  std::vector<std::optional<Scalar>> waiting_;
  std::optional<Pair> next_;
  Scalar time_ = Scalar(0);
  std::int64_t count_ = 0;
};

}  // namespace piblocks
