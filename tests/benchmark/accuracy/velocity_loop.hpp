// The fastest way from collision to collision, in any number type: only velocities are stepped.
// In: a BlockSystem. Out: one collision after the other. Notation: src/physics/README.md.
//
// A collision leaves the size of L and P.V as they are. So positions follow from velocities alone,
// y2 = |L|/|u1| at the wall and y1 = y2 = |L|/|u1 - u2| at contact, and so does the time since the
// turn, P.V/|V|^2: nothing is summed up but the rounding of the velocities.
#pragma once

#include "accuracy/event_loop.hpp"
#include "physics/exact_motion.hpp"

namespace piblocks::benchmark {

template <typename Scalar>
class VelocityLoop {
 public:
  /// @param round  makes a Scalar of a Rational
  template <typename Round>
  VelocityLoop(const ExactMotion& motion, const Round& round)
      : ratio_(round(motion.ratio)),
        blue_share_(round(2 / (1 + motion.ratio))),
        red_share_(round(2 * motion.ratio / (1 + motion.ratio))),
        area_(round(abs(motion.areal_velocity))),
        inverse_speed_squared_(round(1 / motion.speed_squared)),
        u1_(round(motion.u1)),
        u2_(round(motion.u2)),
        blocks_are_next_(motion.blocks_first) {}

  /// Performs the next collision; false if there is none.
  bool step() {
    const bool met = blocks_are_next_ ? meet_blocks() : meet_wall();
    blocks_are_next_ = blocks_are_next_ != met;
    return met;
  }

  /// Of the last collision: who met, how long after the turn, the gaps then and velocities after.
  bool met_blocks() const { return !blocks_are_next_; }
  Scalar tau() const { return tau_; }
  Scalar y1() const { return met_blocks() ? y2_ : Scalar(0); }
  Scalar y2() const { return y2_; }
  Scalar u1() const { return u1_; }
  Scalar u2() const { return u2_; }

 private:
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
};

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
