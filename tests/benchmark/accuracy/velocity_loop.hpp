// The loop over velocities alone: the conserved area gives positions, and these the time.
// In: a BlockSystem. Out: one collision after the other.
//
// Notation of src/physics/README.md. A reflection keeps |L| and P.V, so at the wall y2 = |L|/|u1|,
// at contact y1 = y2 = |L|/(u1 - u2), and the time since the turning point is P.V/|V|^2.
#pragma once

#include "accuracy/event_loop.hpp"

namespace piblocks::benchmark {

template <typename Number>
class VelocityLoop {
 public:
  using Scalar = Number;

  explicit VelocityLoop(const BlockSystem& system) : start_(start_of<Scalar>(system)) {
    const Rational ratio = system.blue.mass / system.red.mass;
    const Rational y1 = system.blue_gap();
    const Rational y2 = y1 + system.blocks_gap();
    const Rational& u1 = system.blue.velocity;
    const Rational& u2 = system.red.velocity;
    const Rational speed_squared = ratio * u1 * u1 + u2 * u2;
    ratio_ = to_scalar<Scalar>(ratio);
    blue_share_ = to_scalar<Scalar>(2 / (1 + ratio));
    red_share_ = to_scalar<Scalar>(2 * ratio / (1 + ratio));
    area_ = to_scalar<Scalar>(abs(y2 * u1 - y1 * u2));
    inverse_speed_squared_ = to_scalar<Scalar>(1 / speed_squared);
    turn_ = to_scalar<Scalar>(-(ratio * y1 * u1 + y2 * u2) / speed_squared);
    blue_corner_ = to_scalar<Scalar>(system.wall_face + system.blue.width / 2);
    red_corner_ = to_scalar<Scalar>(system.wall_face + system.blue.width + system.red.width / 2);
    blue_velocity_ = start_.blue_velocity;
    red_velocity_ = start_.red_velocity;
  }

  Flight<Scalar> start() const { return start_; }

  bool next(Flight<Scalar>& flight) { return pair_is_next_ ? meet_red(flight) : meet_wall(flight); }

 private:
  bool meet_red(Flight<Scalar>& flight) {
    const Scalar closing = blue_velocity_ - red_velocity_;
    if (closing <= 0) return false;
    blue_velocity_ -= blue_share_ * closing;
    red_velocity_ += red_share_ * closing;
    const Scalar y = area_ / closing;
    const Scalar along = y * (ratio_ * blue_velocity_ + red_velocity_);
    flight = {turn_ + along * inverse_speed_squared_, blue_corner_ + y, red_corner_ + y,
              blue_velocity_, red_velocity_};
    pair_is_next_ = false;
    return true;
  }

  bool meet_wall(Flight<Scalar>& flight) {
    if (blue_velocity_ >= 0) return false;
    blue_velocity_ = -blue_velocity_;
    const Scalar y2 = area_ / blue_velocity_;
    flight = {turn_ + y2 * red_velocity_ * inverse_speed_squared_, blue_corner_, red_corner_ + y2,
              blue_velocity_, red_velocity_};
    pair_is_next_ = true;
    return true;
  }

  Flight<Scalar> start_;
  Scalar ratio_;  // m_blue / m_red
  Scalar blue_share_;
  Scalar red_share_;
  Scalar area_;  // |L|
  Scalar inverse_speed_squared_;
  Scalar turn_;  // t_c
  Scalar blue_corner_;
  Scalar red_corner_;
  Scalar blue_velocity_;
  Scalar red_velocity_;
  bool pair_is_next_ = true;
};

}  // namespace piblocks::benchmark
