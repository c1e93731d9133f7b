#include "physics/event_loop.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>

namespace piblocks {
namespace {

using Simulator = EventSimulator<double, 1>;

// In this order a corner hit begins with the blocks: see EventSimulator.
constexpr std::size_t kBlue = 0;
constexpr std::size_t kRed = 1;

Simulator::Body body_of(const Block& block) {
  Simulator::Body body;
  body.mass = to_double(block.mass);
  body.radius = to_double(block.width / 2);
  body.position[0] = to_double(block.position);
  body.velocity[0] = to_double(block.velocity);
  return body;
}

/// The article's wall: an immovable body of radius 1/2 whose far side is the face.
Simulator::Body wall_of(const BlockSystem& system) {
  Simulator::Body body;
  body.mass = kInfiniteMass<double>;
  body.radius = 0.5;
  body.position[0] = to_double(system.wall_face - Rational(1, 2));
  return body;
}

Motion motion_of(const Simulator::Body& body) { return {body.position[0], body.velocity[0]}; }

}  // namespace

std::vector<StoredCollision> event_loop(const BlockSystem& system) {
  Simulator simulator({body_of(system.blue), body_of(system.red), wall_of(system)});
  std::vector<StoredCollision> log;
  while (const auto event = simulator.step()) {
    if (std::int64_t(log.size()) == kMaxStoredCollisions) {
      throw SimulationError(fmt::format(
          "event loop: more than {} collisions; use the closed form (--engine unfolded)",
          kMaxStoredCollisions));
    }
    const bool blocks = event->second == kRed;
    log.push_back({{event->time, 0},
                   blocks ? CollisionKind::blocks : CollisionKind::wall,
                   motion_of(simulator.particles()[kBlue]),
                   motion_of(simulator.particles()[kRed])});
  }
  return log;
}

}  // namespace piblocks
