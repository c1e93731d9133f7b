// The physics engine of a game: fixed steps, and a bounce where two bodies are found to overlap.
// In: a TwoBlocks and a step. Out: the bounces until a given time, at the times of their steps.
#pragma once

#include "accuracy/event_loop.hpp"

namespace piblocks::benchmark {

class EulerLoop {
 public:
  using Scalar = double;

  EulerLoop(const TwoBlocks& system, double step_s, double end_s)
      : step_s_(step_s),
        last_step_(static_cast<std::int64_t>(end_s / step_s)),
        start_(start_of<double>(system)),
        now_(start_),
        wall_contact_(to_double(system.wall_face + system.blue.width / 2)),
        contact_distance_(to_double((system.blue.width + system.red.width) / 2)),
        blue_share_(to_double(2 * system.red.mass / (system.blue.mass + system.red.mass))),
        red_share_(to_double(2 * system.blue.mass / (system.blue.mass + system.red.mass))) {}

  Flight<double> start() const { return start_; }

  bool next(Flight<double>& flight) {
    while (wall_pending_ || steps_ < last_step_) {
      const bool bounced = wall_pending_ ? meet_wall() : step_and_meet_red();
      if (!bounced) continue;
      flight = now_;
      flight.time = static_cast<double>(steps_) * step_s_;
      return true;
    }
    return false;
  }

 private:
  /// The wall is looked at after the blocks, in the same step.
  bool step_and_meet_red() {
    ++steps_;
    now_.blue += now_.blue_velocity * step_s_;
    now_.red += now_.red_velocity * step_s_;
    wall_pending_ = true;
    const double closing = now_.blue_velocity - now_.red_velocity;
    if (now_.red - now_.blue > contact_distance_ || closing <= 0) return false;
    now_.blue_velocity -= blue_share_ * closing;
    now_.red_velocity += red_share_ * closing;
    return true;
  }

  bool meet_wall() {
    wall_pending_ = false;
    if (now_.blue > wall_contact_ || now_.blue_velocity >= 0) return false;
    now_.blue_velocity = -now_.blue_velocity;
    return true;
  }

  double step_s_;
  std::int64_t last_step_;
  Flight<double> start_;
  Flight<double> now_;  // but for the time
  double wall_contact_;
  double contact_distance_;
  double blue_share_;
  double red_share_;
  std::int64_t steps_ = 0;
  bool wall_pending_ = false;
};

}  // namespace piblocks::benchmark
