// The fastest way from collision to collision, in any number type: only velocities are stepped.
// In: a TwoBlocks. Out: one collision after the other. Notation: src/physics/README.md.
//
// A collision leaves the size of L and P.V as they are. So positions follow from velocities alone,
// y2 = |L|/|u1| at the wall and y1 = y2 = |L|/|u1 - u2| at contact, and so does the time since the
// turn, P.V/|V|^2: nothing is summed up but the rounding of the velocities.
#pragma once

#include "accuracy/event_loop.hpp"
#include "physics/exact_motion.hpp"

namespace piblocks::benchmark {

template <typename Number>
class VelocityLoop {
 public:
  using Scalar = Number;

  explicit VelocityLoop(const TwoBlocks& system) : VelocityLoop(system, ExactMotion(system)) {}

  Flight<Scalar> start() const { return start_; }

  bool next(Flight<Scalar>& flight) {
    if (!(blocks_are_next_ ? meet_blocks() : meet_wall())) return false;
    const Scalar y1 = blocks_are_next_ ? y2_ : Scalar(0);
    blocks_are_next_ = !blocks_are_next_;
    flight = {turn_ + tau_, blue_corner_ + y1, red_corner_ + y2_, u1_, u2_};
    return true;
  }

 private:
  VelocityLoop(const TwoBlocks& system, const ExactMotion& motion)
      : ratio_(to_scalar<Scalar>(motion.ratio)),
        blue_share_(to_scalar<Scalar>(2 / (1 + motion.ratio))),
        red_share_(to_scalar<Scalar>(2 * motion.ratio / (1 + motion.ratio))),
        area_(to_scalar<Scalar>(abs(motion.areal_velocity))),
        inverse_speed_squared_(to_scalar<Scalar>(1 / motion.speed_squared)),
        u1_(to_scalar<Scalar>(motion.u1)),
        u2_(to_scalar<Scalar>(motion.u2)),
        blocks_are_next_(motion.blocks_first),
        start_(start_of<Scalar>(system)),
        turn_(to_scalar<Scalar>(motion.closest_approach)),
        blue_corner_(to_scalar<Scalar>(system.wall_face + system.blue.width / 2)),
        red_corner_(
            to_scalar<Scalar>(system.wall_face + system.blue.width + system.red.width / 2)) {}

  bool meet_blocks() {
    const Scalar closing = u1_ - u2_;
    if (!(closing > 0)) return false;
    u1_ -= blue_share_ * closing;
    u2_ += red_share_ * closing;
    y2_ = area_ / closing;
    tau_ = y2_ * (ratio_ * u1_ + u2_) * inverse_speed_squared_;
    return true;
  }

  bool meet_wall() {
    if (!(u1_ < 0)) return false;
    u1_ = -u1_;
    y2_ = area_ / u1_;
    tau_ = y2_ * u2_ * inverse_speed_squared_;
    return true;
  }

  Scalar ratio_;       // m_blue/m_red
  Scalar blue_share_;  // of the closing speed, that blue loses
  Scalar red_share_;
  Scalar area_;  // |L|
  Scalar inverse_speed_squared_;
  Scalar u1_;
  Scalar u2_;
  Scalar y2_{};
  Scalar tau_{};
  bool blocks_are_next_;
  Flight<Scalar> start_;
  Scalar turn_;         // t_c
  Scalar blue_corner_;  // x_blue - y1
  Scalar red_corner_;   // x_red - y2
};

}  // namespace piblocks::benchmark
