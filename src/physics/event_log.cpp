#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "physics/exact_motion.hpp"
#include "physics/logs.hpp"
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

namespace {

/// One collision as a loop meets it; velocities are those just after.
struct StoredCollision {
  Time time;
  CollisionKind kind = CollisionKind::blocks;
  BlockMotion blue;
  BlockMotion red;
};
using StoredCollisions = std::vector<StoredCollision>;

/// The article's event loop. It stops if it finds many more collisions than there are.
StoredCollisions event_loop(const TwoBlocks& blocks) {
  const ExactMotion motion(blocks);
  const Integer count = motion.total();
  const std::size_t limit = 2 * count.get_ui() + 100;
  // The first collision then happens exactly at time 0.
  const bool starts_in_contact =
      !motion.through_corner() && (motion.blocks_first ? motion.y1 == motion.y2 : motion.y1 == 0);
  StoredCollisions log;
  const System system = system_of(blocks);
  const auto stepper = make_event_stepper(system);
  // Blue, red and the wall.
  std::array<BlockMotion, 3> bodies = {motion_of(blocks.blue), motion_of(blocks.red)};
  double now = 0;
  while (const auto step = stepper->step()) {
    for (BlockMotion& body : bodies) body.position += body.velocity * (step->time.hi - now);
    now = step->time.hi;
    bodies.at(step->first) = {step->first_after.position[0], step->first_after.velocity[0]};
    bodies.at(step->second) = {step->second_after.position[0], step->second_after.velocity[0]};
    if (log.size() == limit) {
      throw SimulationError(fmt::format(
          "event loop: more than {} collisions in double precision; the exact count is {}; use the "
          "closed form (--engine unfolded)",
          limit, count.get_str()));
    }
    require_finite(step->time, bodies[0], bodies[1], "event loop");
    // Rounding must not carry a collision past time 0, nor away from it.
    const bool is_at_start = step->time.hi < 0 || (starts_in_contact && log.empty());
    const bool is_at_wall = step->second == system.bodies.size();
    log.push_back({is_at_start ? Time{} : step->time,
                   is_at_wall ? CollisionKind::wall : CollisionKind::blocks, bodies[0], bodies[1]});
  }
  return log;
}

Time negated(const Time& time) { return {-time.hi, -time.lo}; }

/// Collisions before `time`, by binary search; with `or_at` also those at it.
std::size_t count(const StoredCollisions& collisions, const Time& time, bool or_at) {
  const auto is_counted = [&](const Time& t) {
    if (t == time) return or_at;
    return t.hi < time.hi || (t.hi == time.hi && t.lo < time.lo);
  };
  const auto next = std::ranges::partition_point(collisions, is_counted, &StoredCollision::time);
  return static_cast<std::size_t>(next - collisions.begin());
}

/// What a loop recorded, forwards and backwards from time 0.
class EventLog final : public PairLog {
 public:
  /// @param forward   collisions at times >= 0, in order.
  /// @param backward  collisions of the run with all velocities reversed, in its order and with
  ///                  its times and velocities.
  EventLog(const System& system, StoredCollisions forward, StoredCollisions backward)
      : PairLog(system), forward_(std::move(forward)), backward_(std::move(backward)) {
    set_range(1 - Integer(backward_.size()), forward_.size());
  }

  PairCollision blocks_collision(const Integer& index) const override {
    if (index > 0) {
      const StoredCollision& c = forward_[index.get_ui() - 1];
      return {index, c.time, c.kind, c.blue, c.red};
    }
    // The velocities just after this collision are the opposite of those just before it in the
    // reversed run.
    const std::size_t place = Integer(-index).get_ui();
    const StoredCollision& c = backward_[place];
    const BlockMotion blue =
        place == 0 ? motion_of(blocks().blue) : reversed(backward_[place - 1].blue);
    const BlockMotion red =
        place == 0 ? motion_of(blocks().red) : reversed(backward_[place - 1].red);
    return {index,
            negated(c.time),
            c.kind,
            {c.blue.position, blue.velocity},
            {c.red.position, red.velocity}};
  }

  PairState blocks_at(const Rational& time) const override {
    const Time now = to_time(time);
    PairState state{0, motion_of(blocks().blue), motion_of(blocks().red)};
    Time since;
    if (const std::size_t happened = count(forward_, now, true); happened > 0) {
      const StoredCollision& c = forward_[happened - 1];
      since = c.time;
      state = {Integer(happened), c.blue, c.red};
    } else if (const std::size_t to_come = count(backward_, negated(now), false); to_come > 0) {
      const StoredCollision& c = backward_[to_come - 1];
      since = negated(c.time);
      state = {-Integer(to_come), reversed(c.blue), reversed(c.red)};
    }
    const double age = (now.hi - since.hi) + (now.lo - since.lo);
    for (BlockMotion* const block : {&state.blue, &state.red})
      block->position += block->velocity * age;
    require_finite(now, state.blue, state.red, "state");
    return state;
  }

  Rational time_after(const Integer& index) const override {
    Rational time = to_rational(blocks_collision(index).time);
    if (blocks_at(time).count == index) return time;
    throw SimulationError(fmt::format(
        "collision #{}: in double precision it cannot be told apart from its neighbours; use the "
        "closed form (--engine unfolded)",
        index.get_str()));
  }

 private:
  StoredCollisions forward_;
  StoredCollisions backward_;
};

}  // namespace

std::unique_ptr<PairLog> make_event_log(const System& system) {
  require_elastic(system);
  const TwoBlocks blocks = two_blocks_of(system).value();
  const Integer count =
      std::max(ExactMotion(blocks).total(), ExactMotion(reversed(blocks)).total());
  if (count > to_integer(kMaxStoredCollisions)) {
    throw UsageError(fmt::format(
        "event loop: {} collisions are more than the limit of {}; use the closed form (--engine "
        "unfolded)",
        readable(count), readable(to_integer(kMaxStoredCollisions))));
  }
  return std::make_unique<EventLog>(system, event_loop(blocks), event_loop(reversed(blocks)));
}

}  // namespace piblocks
