#include "physics/collapse.hpp"

#include <piblocks/contact.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "physics/impact.hpp"

namespace piblocks {
namespace {

/// So many collisions of a body within the window.
constexpr std::size_t kLeastSteps = 32;
/// Most that is left of the speed with which bodies part, if they are not three on a line. What
/// meets as often in a corner, and almost elastically, keeps more.
constexpr double kMostSpeedLeft = 0x1p-16;

double parting_speed(const System& system, const StoredStep& step) {
  return parting_speed(system, step.second, step.first_after, step.second_after);
}

/// Numbers of three from left to right, as they were at first.
std::array<std::uint32_t, 3> in_order(const System& system,
                                      const std::vector<std::uint32_t>& bodies) {
  const auto is_left = [&](std::uint32_t a, std::uint32_t b) {
    const std::size_t count = system.bodies.size();
    if (a >= count) return system.walls[a - count].normal[0] > 0;
    if (b >= count) return system.walls[b - count].normal[0] < 0;
    return system.bodies[a].position[0] < system.bodies[b].position[0];
  };
  std::array<std::uint32_t, 3> order = {bodies[0], bodies[1], bodies[2]};
  std::ranges::sort(order, is_left);
  return order;
}

/// The share of its parting speed that the last pair has kept since it met before; 1 if this is
/// lost in the rounding of its velocities.
double speed_left_of_round(const System& system, const std::vector<StoredStep>& steps) {
  const StoredStep& last = steps.back();
  const auto before = std::find_if(steps.rbegin() + 1, steps.rend(), [&](const StoredStep& step) {
    return step.first == last.first && step.second == last.second;
  });
  const double speed = parting_speed(system, last);
  const double scale =
      std::fabs(last.first_after.velocity[0]) + std::fabs(last.second_after.velocity[0]);
  if (before == steps.rend() || speed < 0x1p-30 * scale) return 1;
  return speed / parting_speed(system, *before);
}

/// Of three neighbours on a line; nothing of other bodies.
/// @param speed_left  speed_left_of_round()
std::optional<bool> do_three_collapse(const System& system,
                                      const std::vector<std::uint32_t>& bodies, double speed_left) {
  if (system.dimensions != 1 || bodies.size() != 3) return std::nullopt;
  const auto mass = [&](std::uint32_t id) {
    return id < system.bodies.size() ? system.bodies[id].mass : std::nullopt;
  };
  const auto [left, middle, right] = in_order(system, bodies);
  const Rational kappa =
      share_of_change(mass(middle), mass(left)) * share_of_change(mass(middle), mass(right));
  const Rational e = restitution_of(system, left, middle);
  const Rational f = restitution_of(system, middle, right);
  const Rational trace = (1 + e) * (1 + f) * kappa - e - f;
  constexpr double kRounding = 1 - 0x1p-16;
  return trace > 0 && trace * trace >= 4 * e * f && speed_left >= kRounding * to_double(trace) / 2;
}

/// The body and all that it has met since a step, directly or through movable ones.
std::vector<std::uint32_t> bodies_since(const System& system, const std::vector<StoredStep>& steps,
                                        std::uint32_t since, std::uint32_t body) {
  std::set<std::uint32_t> bodies = {body};
  for (std::size_t size = 0; size < bodies.size();) {
    size = bodies.size();
    for (std::size_t number = since; number < steps.size(); ++number) {
      const auto& [first, second] = std::pair(steps[number].first, steps[number].second);
      for (const auto& [own, other] : {std::pair(first, second), std::pair(second, first)}) {
        if (!is_immovable(system, own) && bodies.contains(own)) bodies.insert(other);
      }
    }
  }
  return {bodies.begin(), bodies.end()};
}

}  // namespace

bool is_immovable(const System& system, std::uint32_t id) {
  return id >= system.bodies.size() || !system.bodies[id].mass;
}

std::optional<EndOfSteps> end_of_steps(const System& system, const std::vector<StoredStep>& steps,
                                       const std::vector<Numbers>& of_body, double window,
                                       bool is_exact) {
  const StoredStep& last = steps.back();
  for (const std::uint32_t body : {last.first, last.second}) {
    if (is_immovable(system, body)) continue;
    const Numbers& own = of_body[body];
    const auto since = std::ranges::partition_point(
        own, [&](std::uint32_t number) { return flight(steps[number].time, last.time) > window; });
    const auto count = static_cast<std::size_t>(own.end() - since);
    // What may go on is asked about seldom.
    if (count < kLeastSteps || !std::has_single_bit(count)) continue;
    std::vector<std::uint32_t> bodies = bodies_since(system, steps, *since, body);
    const double first_speed = parting_speed(system, steps[*since]);
    const bool has_stopped = !(parting_speed(system, last) > kMostSpeedLeft * first_speed);
    const std::optional<bool> is_collapse =
        do_three_collapse(system, bodies, speed_left_of_round(system, steps));
    if (is_collapse.value_or(has_stopped)) return EndOfSteps{std::move(bodies), true};
    if (has_stopped && !is_exact) return EndOfSteps{std::move(bodies), false};
  }
  return std::nullopt;
}

}  // namespace piblocks
