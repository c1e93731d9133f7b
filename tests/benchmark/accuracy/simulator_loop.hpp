// The program's general engine, EventSimulator, in one dimension.
// In: a TwoBlocks. Out: one collision after the other.
#pragma once

#include <piblocks/event_simulator.hpp>

#include "accuracy/event_loop.hpp"

namespace piblocks::benchmark {

template <typename Number>
class SimulatorLoop {
 public:
  using Scalar = Number;

  explicit SimulatorLoop(const TwoBlocks& system)
      : start_(start_of<Scalar>(system)),
        simulator_({body_of(system.blue), body_of(system.red), wall_of(system)}) {}

  Flight<Scalar> start() const { return start_; }

  bool next(Flight<Scalar>& flight) {
    if (!simulator_.step()) return false;
    const Body& blue = simulator_.particles()[0];
    const Body& red = simulator_.particles()[1];
    flight = {simulator_.time(), blue.position[0], red.position[0], blue.velocity[0],
              red.velocity[0]};
    return true;
  }

 private:
  using Body = Particle<Scalar, 1>;

  static Body body_of(const Block& block) {
    Body body;
    body.mass = to_scalar<Scalar>(block.mass);
    body.radius = to_scalar<Scalar>(block.width / 2);
    body.position[0] = to_scalar<Scalar>(block.position);
    body.velocity[0] = to_scalar<Scalar>(block.velocity);
    return body;
  }

  static Body wall_of(const TwoBlocks& system) {
    Body body;
    body.mass = kInfiniteMass<Scalar>;
    body.radius = Scalar(0.5);
    body.position[0] = to_scalar<Scalar>(system.wall_face - Rational(1, 2));
    return body;
  }

  Flight<Scalar> start_;
  EventSimulator<Scalar, 1> simulator_;
};

}  // namespace piblocks::benchmark
