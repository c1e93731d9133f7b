#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "physics/stepper.hpp"

namespace piblocks {
namespace {

/// The public simulator with a system's bodies, and its walls after them.
template <int Dim>
class EventStepper final : public Stepper {
 public:
  explicit EventStepper(const System& system) : simulator_(particles_of(system)) {}

  std::optional<SteppedCollision> step() override {
    const auto event = simulator_.step();
    if (!event) return std::nullopt;
    SteppedCollision step;
    step.time = {event->time, 0};
    step.first = static_cast<std::uint32_t>(event->first);
    step.second = static_cast<std::uint32_t>(event->second);
    step.first_after = motion_of(event->first_after);
    step.second_after = motion_of(event->second_after);
    return step;
  }
  double certain_until() const override { return kForEver; }

 private:
  using Simulator = EventSimulator<double, Dim>;
  using Particle = typename Simulator::Body;
  using Vector = typename Particle::Vector;

  static Vector rounded(const ExactVector& exact) {
    Vector vector;
    std::transform(exact.begin(), exact.begin() + Dim, vector.begin(),
                   [](const Rational& x) { return to_double(x); });
    return vector;
  }
  static Motion motion_of(const Particle& particle) {
    Motion motion;
    std::ranges::copy(particle.position, motion.position.begin());
    std::ranges::copy(particle.velocity, motion.velocity.begin());
    return motion;
  }
  static std::vector<Particle> particles_of(const System& system) {
    std::vector<Particle> particles;
    for (const Body& body : system.bodies) {
      particles.push_back({.mass = body.mass ? to_double(*body.mass) : kInfiniteMass<double>,
                           .radius = to_double(Dim == 1 ? Rational(body.size / 2) : body.size),
                           .position = rounded(body.position),
                           .velocity = rounded(body.velocity)});
    }
    for (const Wall& wall : system.walls) {
      particles.push_back({.mass = kInfiniteMass<double>,
                           .position = rounded(wall.point),
                           .velocity = rounded(wall.velocity),
                           .facing = rounded(wall.normal)});
    }
    return particles;
  }

  Simulator simulator_;
};

}  // namespace

void require_elastic(const System& system) {
  if (is_elastic(system)) return;
  throw UsageError("event loop: its collisions are elastic; leave out --engine events");
}

std::unique_ptr<Stepper> make_event_stepper(const System& system) {
  require_elastic(system);
  // If a scene of discs does not say how contacts are taken, this engine takes them in order.
  if (system.contacts == Contacts::at_once) {
    throw UsageError("event loop: it takes contacts in order; leave out --engine events");
  }
  if (system.bodies.size() > kMaxEventBodies) {
    throw UsageError(fmt::format(
        "event loop: {} bodies are more than the limit of {}; leave out --engine events",
        system.bodies.size(), kMaxEventBodies));
  }
  if (system.dimensions == 1) return std::make_unique<EventStepper<1>>(system);
  return std::make_unique<EventStepper<2>>(system);
}

}  // namespace piblocks
