// The program's loop over velocities alone, in any number type.
// In: a BlockSystem. Out: one collision after the other.
#pragma once

#include "accuracy/event_loop.hpp"
#include "physics/velocity_loop.hpp"

namespace piblocks::benchmark {

/// Adds to the loop what it leaves to its caller: when the turn is, and where the corner.
template <typename Number>
class VelocityStepper {
 public:
  using Scalar = Number;

  explicit VelocityStepper(const BlockSystem& system)
      : VelocityStepper(system, ExactMotion(system)) {}

  Flight<Scalar> start() const { return start_; }

  bool next(Flight<Scalar>& flight) {
    if (!loop_.step()) return false;
    flight = {turn_ + loop_.tau(), blue_corner_ + loop_.y1(), red_corner_ + loop_.y2(), loop_.u1(),
              loop_.u2()};
    return true;
  }

 private:
  VelocityStepper(const BlockSystem& system, const ExactMotion& motion)
      : loop_(motion, to_scalar<Scalar>),
        start_(start_of<Scalar>(system)),
        turn_(to_scalar<Scalar>(motion.closest_approach)),
        blue_corner_(to_scalar<Scalar>(system.wall_face + system.blue.width / 2)),
        red_corner_(
            to_scalar<Scalar>(system.wall_face + system.blue.width + system.red.width / 2)) {}

  VelocityLoop<Scalar> loop_;
  Flight<Scalar> start_;
  Scalar turn_;         // t_c
  Scalar blue_corner_;  // x_blue - y1
  Scalar red_corner_;   // x_red - y2
};

}  // namespace piblocks::benchmark
