// The loop over gaps: no body has a position, only the two gaps and how fast they close.
// In: a TwoBlocks. Out: one collision after the other.
#pragma once

#include "accuracy/event_loop.hpp"

namespace piblocks::benchmark {

template <typename Number>
class GapLoop {
 public:
  using Scalar = Number;

  explicit GapLoop(const TwoBlocks& system)
      : start_(start_of<Scalar>(system)),
        blue_corner_(to_scalar<Scalar>(system.wall_face + system.blue.width / 2)),
        contact_distance_(to_scalar<Scalar>((system.blue.width + system.red.width) / 2)),
        blue_share_(to_scalar<Scalar>(2 * system.red.mass / (system.blue.mass + system.red.mass))),
        red_share_(to_scalar<Scalar>(2 * system.blue.mass / (system.blue.mass + system.red.mass))),
        wall_gap_(to_scalar<Scalar>(system.blue_gap())),
        blocks_gap_(to_scalar<Scalar>(system.blocks_gap())),
        blue_velocity_(start_.blue_velocity),
        red_velocity_(start_.red_velocity) {}

  Flight<Scalar> start() const { return start_; }

  bool next(Flight<Scalar>& flight) {
    if (!(pair_is_next_ ? meet_red() : meet_wall())) return false;
    pair_is_next_ = !pair_is_next_;
    const Scalar blue = blue_corner_ + wall_gap_;
    flight = {time_, blue, blue + contact_distance_ + blocks_gap_, blue_velocity_, red_velocity_};
    return true;
  }

 private:
  bool meet_red() {
    const Scalar closing = blue_velocity_ - red_velocity_;
    if (closing <= 0) return false;
    const Scalar wait = blocks_gap_ / closing;
    time_ += wait;
    wall_gap_ += blue_velocity_ * wait;
    blocks_gap_ = Scalar(0);
    blue_velocity_ -= blue_share_ * closing;
    red_velocity_ += red_share_ * closing;
    return true;
  }

  bool meet_wall() {
    if (blue_velocity_ >= 0) return false;
    const Scalar wait = wall_gap_ / -blue_velocity_;
    time_ += wait;
    wall_gap_ = Scalar(0);
    blocks_gap_ += (red_velocity_ - blue_velocity_) * wait;
    blue_velocity_ = -blue_velocity_;
    return true;
  }

  Flight<Scalar> start_;
  Scalar blue_corner_;       // blue's centre at the wall
  Scalar contact_distance_;  // of the centres when the blocks touch
  Scalar blue_share_;
  Scalar red_share_;
  Scalar time_ = Scalar(0);
  Scalar wall_gap_;
  Scalar blocks_gap_;
  Scalar blue_velocity_;
  Scalar red_velocity_;
  bool pair_is_next_ = true;
};

}  // namespace piblocks::benchmark
