#include <piblocks/error.hpp>

#include <cassert>
#include <optional>
#include <string>

#include "support/oracle.hpp"

namespace piblocks::oracle {
namespace {

struct Blocks {
  ExactMotion blue;
  ExactMotion red;
};

Blocks start_of(const TwoBlocks& system) {
  return {{system.blue.position, system.blue.velocity}, {system.red.position, system.red.velocity}};
}

ExactMotion after(const ExactMotion& motion, const Rational& dt) {
  return {motion.position + motion.velocity * dt, motion.velocity};
}

Blocks after(const Blocks& blocks, const Rational& dt) {
  return {after(blocks.blue, dt), after(blocks.red, dt)};
}

std::optional<Rational> time_to_close(const Rational& gap, const Rational& closing_speed) {
  if (closing_speed <= 0) return std::nullopt;
  return Rational(gap / closing_speed);
}

/// Elastic collision: each velocity is reflected in that of the common centre of mass.
void exchange_momentum(const TwoBlocks& system, Blocks& blocks) {
  const Rational& m_blue = system.blue.mass;
  const Rational& m_red = system.red.mass;
  const Rational centre =
      (m_blue * blocks.blue.velocity + m_red * blocks.red.velocity) / (m_blue + m_red);
  blocks.blue.velocity = 2 * centre - blocks.blue.velocity;
  blocks.red.velocity = 2 * centre - blocks.red.velocity;
}

}  // namespace

TwoBlocks reversed(const TwoBlocks& system) {
  TwoBlocks result = system;
  result.blue.velocity = -system.blue.velocity;
  result.red.velocity = -system.red.velocity;
  return result;
}

std::vector<ExactEvent> exact_run(const TwoBlocks& system, std::int64_t max_events) {
  const Rational blue_at_wall = system.wall_face + system.blue.width / 2;
  const Rational contact = (system.blue.width + system.red.width) / 2;
  std::vector<ExactEvent> events;
  Blocks now = start_of(system);
  Rational time = 0;
  while (true) {
    const std::optional<Rational> wall =
        time_to_close(now.blue.position - blue_at_wall, -now.blue.velocity);
    const std::optional<Rational> blocks = time_to_close(
        now.red.position - now.blue.position - contact, now.blue.velocity - now.red.velocity);
    if (!wall && !blocks) return events;
    if (std::ssize(events) == max_events) {
      throw SimulationError("oracle: more than " + std::to_string(max_events) + " collisions");
    }
    const bool blocks_meet = blocks && (!wall || *blocks <= *wall);
    const Rational& dt = blocks_meet ? *blocks : *wall;
    time += dt;
    now = after(now, dt);
    if (blocks_meet) {
      exchange_momentum(system, now);
    } else {
      now.blue.velocity = -now.blue.velocity;
    }
    events.push_back(
        {blocks_meet ? CollisionKind::blocks : CollisionKind::wall, time, now.blue, now.red});
  }
}

ExactState exact_state(const TwoBlocks& system, const std::vector<ExactEvent>& run,
                       const Rational& t, std::int64_t max_events) {
  if (t < 0) {
    const TwoBlocks past = reversed(system);
    std::vector<ExactEvent> past_run = exact_run(past, max_events);
    // A collision exactly at t has happened at t, so it is not among those still to come.
    std::erase_if(past_run, [&](const ExactEvent& event) { return event.time >= -t; });
    ExactState state = exact_state(past, past_run, -t);
    state.count = -state.count;
    state.blue.velocity = -state.blue.velocity;
    state.red.velocity = -state.red.velocity;
    return state;
  }
  const auto next = std::upper_bound(
      run.begin(), run.end(), t,
      [](const Rational& time, const ExactEvent& event) { return time < event.time; });
  if (next == run.begin()) {
    const Blocks now = after(start_of(system), t);
    return {0, now.blue, now.red};
  }
  const ExactEvent& last = *std::prev(next);
  const Blocks now = after(Blocks{last.blue, last.red}, Rational(t - last.time));
  return {Integer(static_cast<long>(next - run.begin())), now.blue, now.red};
}

}  // namespace piblocks::oracle
