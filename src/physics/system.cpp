#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <optional>

#include "physics/exact_line.hpp"
#include "physics/problems.hpp"

namespace piblocks {
namespace {

Rational largest_abs(const ExactVector& vector) { return std::max(abs(vector[0]), abs(vector[1])); }

/// Collects what is wrong with each body alone. In closed form masses may be of any size.
void check_body(const System& system, std::size_t index, bool is_pair, SceneProblems& problems) {
  const Body& body = system.bodies[index];
  const auto key = [&](const char* value) { return key_of(system, index, value); };
  const char* const size = system.dimensions == 1 ? "width" : "radius";
  if (body.mass) {
    problems.require_positive(key("mass"), *body.mass);
    if (!is_pair) problems.require_finite(key("mass"), *body.mass);
  }
  problems.require_positive(key(size), body.size);
  problems.require_finite(key(size), body.size);
  problems.require_finite(key("position"), largest_abs(body.position));
  problems.require_finite(key("velocity"), largest_abs(body.velocity));
}

void check_dimensions(const System& system, SceneProblems& problems) {
  problems.require(system.dimensions == 1 || system.dimensions == 2, "body",
                   "has {} dimensions: must have 1 or 2", system.dimensions);
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const Body& body = system.bodies[i];
    const bool is_flat = body.position[1] == 0 && body.velocity[1] == 0;
    problems.require(system.dimensions == 2 || is_flat, key_of(system, i, "position"),
                     "has two coordinates: blocks are on a line");
  }
  for (std::size_t i = 0; i < system.walls.size(); ++i) {
    const Wall& wall = system.walls[i];
    problems.require_finite(fmt::format("wall {}.velocity", i + 1), largest_abs(wall.velocity));
    const bool is_short = has_short_names(system);
    problems.require_finite(is_short ? "wall.face" : fmt::format("wall {}.point", i + 1),
                            largest_abs(wall.point));
    const std::string key = fmt::format("wall {}.normal", i + 1);
    if (wall.normal[0] == 0 && wall.normal[1] == 0) {
      problems.add(key, "= [0, 0]: must not be 0");
    } else if (system.dimensions == 1 && wall.normal[1] != 0) {
      problems.add(
          key,
          "makes the {}, but blocks move along x alone; leave it out, or give the bodies a radius",
          noun_of(wall));
    }
  }
}

/// On a line the nearest wall of a side is the only one that matters, and must stay the nearest.
void check_sides(const System& system, SceneProblems& problems) {
  for (const int side : {1, -1}) {
    const auto is_there = [&](const Wall& wall) { return sgn(wall.normal[0]) == side; };
    const auto moves_there = [&](const Wall& wall) { return is_there(wall) && is_moving(wall); };
    if (std::ranges::count_if(system.walls, is_there) < 2) continue;
    problems.require(std::ranges::none_of(system.walls, moves_there), "wall",
                     "moves, and another one is on the same side; leave one of them out");
  }
}

void check_restitution(const System& system, SceneProblems& problems) {
  const auto check = [&](const std::string& key, const Rational& value) {
    problems.require(value >= 0 && value <= 1, key,
                     "= {}: must be from 0 (no rebound) to 1 (elastic)", value);
  };
  check("blocks.restitution", system.restitution);
  check("wall.restitution", system.wall_restitution);
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    if (const auto& own = system.bodies[i].restitution)
      check(key_of(system, i, "restitution"), *own);
  }
  for (std::size_t i = 0; i < system.walls.size(); ++i) {
    if (const auto& own = system.walls[i].restitution) {
      check(fmt::format("wall {}.restitution", i + 1), *own);
    }
  }
}

}  // namespace

std::string name_of(const System& system, std::size_t body) {
  const std::string& name = system.bodies[body].name;
  return name.empty() ? body_key(system, body) : name;
}
std::string key_of(const System& system, std::size_t body, const char* value) {
  return fmt::format("{}.{}", name_of(system, body), value);
}
std::string noun_of(const Wall& wall) {
  return wall.name == "wall" ? wall.name : wall.name + " wall";
}

void require_valid(const std::vector<Problem>& problems) {
  if (!problems.empty()) throw SceneError(problems);
}

std::vector<Problem> problems_of(const System& system) {
  SceneProblems problems;
  problems.require(!system.bodies.empty(), "body", "is missing: there must be at least one");
  problems.require(system.bodies.size() <= kMaxBodies, "body",
                   "= {} of them: at most {} can be shown", system.bodies.size(), kMaxBodies);
  problems.require(system.walls.size() <= kMaxWalls, "wall",
                   "= {} of them: at most {} are possible", system.walls.size(), kMaxWalls);
  if (!problems.empty()) return problems.take();
  check_dimensions(system, problems);
  const bool is_pair = two_blocks_of(system).has_value();
  for (std::size_t i = 0; i < system.bodies.size(); ++i) check_body(system, i, is_pair, problems);
  if (system.dimensions == 1) check_sides(system, problems);
  check_restitution(system, problems);
  const bool can_move =
      std::ranges::any_of(system.bodies, [](const Body& body) { return body.mass.has_value(); });
  problems.require(can_move, "body", "all have infinite mass: nothing can move");
  if (!problems.empty()) return problems.take();  // what follows would only repeat them
  check_overlaps(system, problems);
  return problems.take();
}

bool may_never_end(const System& system) {
  if (system.dimensions == 1) {
    const std::vector<LineElement> elements = elements_of(system);
    const auto is_fixed = [](const LineElement& element) { return !element.mass; };
    const auto first = std::ranges::find_if(elements, is_fixed);
    const auto last = std::ranges::find_if(elements.rbegin(), elements.rend(), is_fixed);
    return first != elements.end() && !std::all_of(first, last.base(), is_fixed);
  }
  // Discs get away from all walls if these face one open half-plane: if seen from one of their
  // normals all others are less than half a turn to its left.
  const auto cross = [](const ExactVector& a, const ExactVector& b) -> Rational {
    return a[0] * b[1] - a[1] * b[0];
  };
  const auto is_rightmost = [&](const Wall& wall) {
    return std::ranges::all_of(system.walls, [&](const Wall& other) {
      const int side = sgn(cross(wall.normal, other.normal));
      return side > 0 || (side == 0 && dot(wall.normal, other.normal) > 0);
    });
  };
  const bool is_enclosed =
      !system.walls.empty() && std::ranges::none_of(system.walls, is_rightmost);
  const auto fixed = std::ranges::count_if(system.bodies, [](const Body& b) { return !b.mass; });
  return is_enclosed || fixed + (system.walls.empty() ? 0 : 1) >= 2;
}

Rational mass_ratio_of(int digits, int base) {
  if (digits < 1 || digits > kMaxDigits) {
    throw UsageError(fmt::format("digits = {}: must be from 1 to {}", digits, kMaxDigits));
  }
  if (base < kMinBase || base > kMaxBase) {
    throw UsageError(fmt::format("base = {}: must be from {} to {}", base, kMinBase, kMaxBase));
  }
  return power(base * base, static_cast<unsigned long>(digits - 1));
}

System article_system(int digits, int base) { return system_of(article_blocks(digits, base)); }

std::string body_key(const System& system, std::size_t body) {
  const std::string& name = system.bodies[body].name;
  return name.starts_with("body ") ? name : fmt::format("body {}", body + 1);
}

bool has_short_names(const System& system) {
  const std::vector<Body>& bodies = system.bodies;
  const std::vector<Wall>& walls = system.walls;
  return system.dimensions == 1 && bodies.size() == 2 && walls.size() == 1 &&
         bodies[0].name == "blue" && bodies[1].name == "red" && bodies[0].mass && bodies[1].mass &&
         walls[0].name == "wall" && walls[0].normal[0] > 0 && walls[0].velocity[0] == 0 &&
         !are_at_once(system);
}

Rational restitution_of(const System& system, std::size_t first, std::size_t second) {
  const std::size_t count = system.bodies.size();
  const bool has_immovable = is_immovable(system, first) || is_immovable(system, second);
  const Rational& usual = has_immovable ? system.wall_restitution : system.restitution;
  const auto own = [&](std::size_t id) -> const Rational& {
    const auto& value =
        id < count ? system.bodies[id].restitution : system.walls[id - count].restitution;
    return value ? *value : usual;
  };
  return std::min(own(first), own(second));
}

bool are_at_once(const System& system) {
  const Contacts usual = system.dimensions == 2 ? Contacts::at_once : Contacts::in_order;
  return system.contacts.value_or(usual) == Contacts::at_once;
}

bool is_elastic(const System& system) {
  const auto keeps = [](const auto& one) { return !one.restitution || *one.restitution == 1; };
  return system.restitution == 1 && system.wall_restitution == 1 &&
         std::ranges::all_of(system.bodies, keeps) && std::ranges::all_of(system.walls, keeps);
}

bool is_immovable(const System& system, std::size_t id) {
  return id >= system.bodies.size() || !system.bodies[id].mass;
}

bool is_moving(const Wall& wall) { return wall.velocity[0] != 0 || wall.velocity[1] != 0; }

bool is_driven(const System& system) {
  const auto is_moving_body = [](const Body& body) {
    return !body.mass && (body.velocity[0] != 0 || body.velocity[1] != 0);
  };
  return std::ranges::any_of(system.walls, is_moving) ||
         std::ranges::any_of(system.bodies, is_moving_body);
}

}  // namespace piblocks
