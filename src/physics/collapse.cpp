#include <piblocks/contact.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "physics/stepper.hpp"

namespace piblocks {
namespace {

/// So many collisions of a body within the window.
constexpr std::size_t kLeastSteps = 32;
/// So many collisions of a disc at one instant, if contacts are at once.
constexpr std::size_t kLeastAtOnce = 1024;
/// Most that is left of the speed with which bodies part, if they are not three on a line. What
/// meets as often in a corner, and almost elastically, keeps more.
constexpr double kMostSpeedLeft = 0x1p-16;

/// The speed along the line between two with which they part.
double parting_speed(const System& system, const StoredStep& step) {
  const auto& [x, u] = step.first_after;
  const auto& [y, v] = step.second_after;
  std::array<double, 2> way = {y[0] - x[0], y[1] - x[1]};
  if (step.second >= system.bodies.size()) {
    const ExactVector& normal = system.walls[step.second - system.bodies.size()].normal;
    way = {-to_double(normal[0]), -to_double(normal[1])};
  }
  const double length = std::sqrt(way[0] * way[0] + way[1] * way[1]);
  return std::fabs((v[0] - u[0]) * way[0] + (v[1] - u[1]) * way[1]) / (length > 0 ? length : 1);
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
  if (before == steps.rend() || speed <= 0x1p-30 * scale) return 1;
  return speed / parting_speed(system, *before);
}

/// Of three neighbours on a line; nothing of other bodies.
std::optional<bool> do_three_collapse(const System& system,
                                      const std::vector<std::uint32_t>& bodies,
                                      const std::vector<StoredStep>& steps) {
  if (system.dimensions != 1 || bodies.size() != 3) return std::nullopt;
  const auto mass = [&](std::uint32_t id) {
    return id < system.bodies.size() ? system.bodies[id].mass : std::nullopt;
  };
  std::vector<std::uint32_t> in_order = bodies;  // which never changes
  std::ranges::sort(in_order, {}, [&](std::uint32_t id) {
    const std::size_t count = system.bodies.size();
    return id < count ? std::pair(0, system.bodies[id].position[0])
                      : std::pair(-sgn(system.walls[id - count].normal[0]), Rational(0));
  });
  const std::uint32_t left = in_order[0];
  const std::uint32_t middle = in_order[1];
  const std::uint32_t right = in_order[2];
  const Rational kappa =
      share_of_change(mass(middle), mass(left)) * share_of_change(mass(middle), mass(right));
  const Rational e = restitution_of(system, middle, left);
  const Rational f = restitution_of(system, middle, right);
  const Rational trace = (1 + e) * (1 + f) * kappa - e - f;
  constexpr double kRounding = 1 - 0x1p-16;
  return trace > 0 && trace * trace >= 4 * e * f &&
         speed_left_of_round(system, steps) >= kRounding * to_double(trace) / 2;
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

std::optional<EndOfSteps> end_of_steps(const System& system, const std::vector<StoredStep>& steps,
                                       const std::vector<StepNumbers>& of_body, double window,
                                       bool is_exact) {
  const StoredStep& last = steps.back();
  for (const std::uint32_t body : {last.first, last.second}) {
    if (is_immovable(system, body)) continue;
    const StepNumbers& own = of_body[body];
    const auto is_before = [&](std::uint32_t number) {
      return flight(steps[number].time, last.time) > window;
    };
    if (own.size() < kLeastSteps || is_before(own[own.size() - kLeastSteps])) continue;
    const auto since = std::ranges::partition_point(own, is_before);
    const auto count = static_cast<std::size_t>(own.end() - since);
    // Discs at once have a rule for what follows, which ends after few stages.
    const bool is_one_instant = system.dimensions == 2 && are_at_once(system) &&
                                !(flight(steps[*since].time, last.time) > 0);
    // What may go on is asked about seldom.
    if ((is_one_instant && count < kLeastAtOnce) || !std::has_single_bit(count)) continue;
    std::vector<std::uint32_t> bodies = bodies_since(system, steps, *since, body);
    const double first_speed = parting_speed(system, steps[*since]);
    const bool has_stopped = !(parting_speed(system, last) > kMostSpeedLeft * first_speed);
    const std::optional<bool> is_collapse = do_three_collapse(system, bodies, steps);
    if (is_collapse.value_or(has_stopped)) return EndOfSteps{std::move(bodies), true};
    if (has_stopped && !is_exact) return EndOfSteps{std::move(bodies), false};
  }
  return std::nullopt;
}

}  // namespace piblocks
