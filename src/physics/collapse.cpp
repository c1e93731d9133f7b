#include "physics/collapse.hpp"

#include <piblocks/contact.hpp>

#include <algorithm>
#include <array>

namespace piblocks {
namespace {

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

}  // namespace

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

}  // namespace piblocks
