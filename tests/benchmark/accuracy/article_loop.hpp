// The article's loop: bodies at absolute positions, when two of them touch from a quadratic.
// In: a TwoBlocks. Out: one collision after the other.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "accuracy/event_loop.hpp"

namespace piblocks::benchmark {

template <typename Number>
class ArticleLoop {
 public:
  using Scalar = Number;

  explicit ArticleLoop(const TwoBlocks& system)
      : start_(start_of<Scalar>(system)),
        bodies_{{{to_scalar<Scalar>(system.wall_face) - Scalar(0.5), Scalar(0), Scalar(0.5)},
                 {start_.blue, start_.blue_velocity, to_scalar<Scalar>(system.blue.width / 2)},
                 {start_.red, start_.red_velocity, to_scalar<Scalar>(system.red.width / 2)}}},
        blue_share_(to_scalar<Scalar>(2 * system.red.mass / total_mass(system))),
        red_share_(to_scalar<Scalar>(2 * system.blue.mass / total_mass(system))) {}

  Flight<Scalar> start() const { return start_; }

  bool next(Flight<Scalar>& flight) {
    // A pair that has just met cannot be the next to meet.
    const std::optional<Scalar> wait = pair_is_next_ ? meeting(bodies_[kBlue], bodies_[kRed])
                                                     : meeting(bodies_[kWall], bodies_[kBlue]);
    if (!wait) return false;
    time_ += *wait;
    for (Body& body : bodies_) body.position += body.velocity * *wait;
    pair_is_next_ ? meet_red() : meet_wall();
    pair_is_next_ = !pair_is_next_;
    flight = {time_, bodies_[kBlue].position, bodies_[kRed].position, bodies_[kBlue].velocity,
              bodies_[kRed].velocity};
    return true;
  }

 private:
  struct Body {
    Scalar position;
    Scalar velocity;
    Scalar radius;
  };
  enum Name : std::size_t { kWall, kBlue, kRed };

  static Rational total_mass(const TwoBlocks& system) { return system.blue.mass + system.red.mass; }

  /// The smaller root of |x + v t| = reach.
  static std::optional<Scalar> meeting(const Body& left, const Body& right) {
    using std::sqrt;
    const Scalar x = right.position - left.position;
    const Scalar v = right.velocity - left.velocity;
    const Scalar reach = left.radius + right.radius;
    const Scalar a = v * v;
    const Scalar half_b = x * v;
    if (half_b >= 0) return std::nullopt;
    const Scalar discriminant = half_b * half_b - a * (x * x - reach * reach);
    if (discriminant < 0) return std::nullopt;
    return Scalar((-half_b - sqrt(discriminant)) / a);
  }

  void meet_red() {
    const Scalar closing = bodies_[kBlue].velocity - bodies_[kRed].velocity;
    bodies_[kBlue].velocity -= blue_share_ * closing;
    bodies_[kRed].velocity += red_share_ * closing;
  }

  void meet_wall() { bodies_[kBlue].velocity = -bodies_[kBlue].velocity; }

  Flight<Scalar> start_;
  std::array<Body, 3> bodies_;
  Scalar blue_share_;  // of twice the closing speed, lost by blue
  Scalar red_share_;
  Scalar time_ = Scalar(0);
  bool pair_is_next_ = true;
};

}  // namespace piblocks::benchmark
