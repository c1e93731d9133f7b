#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>

#include "physics/exact_line.hpp"
#include "physics/problems.hpp"

namespace piblocks {
namespace {

/// What messages call a body.
std::string name_of(const System& system, std::size_t body) {
  const std::string& name = system.bodies[body].name;
  return name.empty() ? body_key(system, body) : name;
}
std::string key_of(const System& system, std::size_t body, const char* value) {
  return fmt::format("{}.{}", name_of(system, body), value);
}
/// As in "the left wall", or "the wall".
std::string noun_of(const Wall& wall) {
  return wall.name == "wall" ? wall.name : wall.name + " wall";
}

Rational dot(const ExactVector& a, const ExactVector& b) { return a[0] * b[0] + a[1] * b[1]; }
ExactVector difference(const ExactVector& a, const ExactVector& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

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
  const auto larger = [](const ExactVector& vector) {
    return std::max(abs(vector[0]), abs(vector[1]));
  };
  problems.require_finite(key("position"), larger(body.position));
  problems.require_finite(key("velocity"), larger(body.velocity));
}

/// By how much a distance, whose square is given, is less than the reach; also if that is little.
double shortfall(const Rational& reach, const Rational& square) {
  const Rational share = square / Rational(reach * reach);
  return to_double(reach) * to_double(Rational(1 - share)) / (1 + std::sqrt(to_double(share)));
}

/// How far a body may overlap what it touches: a few roundings of its coordinates. Numbers rounded
/// to doubles, or to as many decimals, cannot say touching more exactly.
Rational tolerance_of(const Body& body) {
  return (abs(body.position[0]) + abs(body.position[1]) + body.size) >> 50;
}
Rational tolerance_of(const Wall& wall) { return (abs(wall.point[0]) + abs(wall.point[1])) >> 50; }
Rational tolerated_size(const Body& body, const Rational& tolerance) {
  return std::max(Rational(body.size - tolerance), Rational(body.size / 2));
}

void check_wall(const System& system, const Wall& wall, std::size_t index,
                SceneProblems& problems) {
  const Body& body = system.bodies[index];
  const Rational reach = tolerated_size(body, tolerance_of(body) + tolerance_of(wall));
  const Rational along = dot(difference(body.position, wall.point), wall.normal);
  const Rational square = dot(wall.normal, wall.normal);
  if (along >= 0 && along * along >= reach * reach * square) return;
  const double within = shortfall(body.size, Rational(along * along / square));
  problems.add(key_of(system, index, "position"), "= [{}, {}]: reaches {:.3g} beyond the {}",
               body.position[0], body.position[1],
               along >= 0 ? within : 2 * to_double(body.size) - within, noun_of(wall));
}

/// What must be from left to right: wall, blue, red.
void check_places(const System& system, SceneProblems& problems) {
  const Rational& wall_face = system.walls[0].point[0];
  const Rational& blue = system.bodies[0].position[0];
  const Rational& red = system.bodies[1].position[0];
  const Rational half_blue = system.bodies[0].size / 2;
  const Rational reach = half_blue + system.bodies[1].size / 2;
  const Rational least_blue = wall_face + half_blue;
  if (blue + half_blue <= wall_face) {
    problems.add("blue.position",
                 "= {}: blue is left of the wall's face at {}; must be at least {}", blue,
                 wall_face, least_blue);
  } else if (blue < least_blue) {
    problems.add("blue.position",
                 "= {}: blue reaches {} into the wall, whose face is at {}; must be at least {}",
                 blue, Rational(least_blue - blue), wall_face, least_blue);
  }
  const Rational least_red = blue + reach;
  if (red <= blue - reach) {
    problems.add("red.position", "= {}: red is left of blue; must be at least {}", red, least_red);
  } else if (red < least_red) {
    problems.add("red.position", "= {}: red overlaps blue by {}; must be at least {}", red,
                 Rational(least_red - red), least_red);
  }
}

/// Blocks that overlap their neighbour, or are beyond a wall. The closed form needs exact gaps.
void check_line(const System& system, SceneProblems& problems) {
  std::vector<std::size_t> order(system.bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return system.bodies[i].position[0]; });
  const bool is_exact = two_blocks_of(system).has_value();
  const auto tolerance = [&](const auto& one, const auto& other) {
    return is_exact ? Rational(0) : Rational(tolerance_of(one) + tolerance_of(other));
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Body& body = system.bodies[order[i]];
    for (const Wall& wall : system.walls) {
      const Rational inside = sgn(wall.normal[0]) * (body.position[0] - wall.point[0]);
      problems.require(inside >= body.size / 2 - tolerance(body, wall),
                       key_of(system, order[i], "position"), "= {}: reaches {} beyond the {}",
                       body.position[0], Rational(body.size / 2 - inside), noun_of(wall));
    }
    if (i == 0) continue;
    const Body& left = system.bodies[order[i - 1]];
    const Rational gap = body.position[0] - left.position[0] - (body.size + left.size) / 2;
    problems.require(gap >= -tolerance(body, left), key_of(system, order[i], "position"),
                     "= {}: overlaps {} by {}", body.position[0], name_of(system, order[i - 1]),
                     Rational(-gap));
  }
}

/// Finds discs that overlap, in n log n steps whatever their sizes and places are (Shamos and Hoey,
/// 1976). A vertical line sweeps over them from left to right. Discs that it crosses lie on it in
/// the order of their centres, as long as none overlap. So only neighbours on the line are
/// compared, whenever two become neighbours. Of two that overlap, the line loses the one with the
/// higher number.
class OverlapSweep {
 public:
  explicit OverlapSweep(const std::vector<Body>& bodies)
      : bodies_(bodies),
        overlapped_(bodies.size()),
        place_(bodies.size()),
        disc_at_(bodies.size()) {
    std::iota(disc_at_.begin(), disc_at_.end(), std::size_t{0});
    std::ranges::stable_sort(disc_at_, [&](std::size_t a, std::size_t b) {
      return bodies[a].position[1] < bodies[b].position[1];
    });
    for (std::size_t i = 0; i < place_.size(); ++i) place_[disc_at_[i]] = i;
    for (const auto& [x, begins, disc] : events()) begins ? enter(disc) : leave(disc);
  }

  /// Of each disc that the line has lost, the one that it overlaps.
  const std::vector<std::optional<std::size_t>>& overlapped() const { return overlapped_; }

 private:
  using Line = std::set<std::size_t>;  // places in the order of the centres

  struct Event {
    Rational x;
    bool begins;
    std::size_t disc;
  };

  /// From left to right. Discs may touch: where one ends and another begins, the one ends first.
  std::vector<Event> events() const {
    std::vector<Event> events;
    events.reserve(2 * bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      events.push_back({bodies_[i].position[0] - bodies_[i].size, true, i});
      events.push_back({bodies_[i].position[0] + bodies_[i].size, false, i});
    }
    std::ranges::stable_sort(events, [](const Event& a, const Event& b) {
      const int order = cmp(a.x, b.x);
      return order < 0 || (order == 0 && !a.begins && b.begins);
    });
    return events;
  }

  void enter(std::size_t disc) {
    const auto entered = line_.insert(place_[disc]).first;
    compare_before(entered);
    if (!overlapped_[disc]) compare_before(std::next(entered));
  }

  void leave(std::size_t disc) {
    if (!overlapped_[disc]) compare_before(line_.erase(line_.find(place_[disc])));
  }

  /// Compares a disc on the line with the one before it.
  void compare_before(Line::iterator disc) {
    while (disc != line_.begin() && disc != line_.end()) {
      const auto before = std::prev(disc);
      if (!overlap(disc_at_[*before], disc_at_[*disc])) return;
      const bool loses_before = disc_at_[*before] > disc_at_[*disc];
      const auto lost = loses_before ? before : disc;
      overlapped_[disc_at_[*lost]] = disc_at_[*(loses_before ? disc : before)];
      disc = line_.erase(lost);
    }
  }

  bool overlap(std::size_t a, std::size_t b) const {
    const Rational reach = bodies_[a].size + bodies_[b].size;
    const ExactVector apart = difference(bodies_[a].position, bodies_[b].position);
    return dot(apart, apart) < reach * reach;
  }

  const std::vector<Body>& bodies_;
  std::vector<std::optional<std::size_t>> overlapped_;
  std::vector<std::size_t> place_;    // of a disc, in the order of the centres
  std::vector<std::size_t> disc_at_;  // of a place
  Line line_;
};

/// Discs that are beyond a wall, or overlap.
void check_plane(const System& system, SceneProblems& problems) {
  const std::vector<Body>& bodies = system.bodies;
  // Each disc gives way by its own tolerance, so the sweep finds true overlaps exactly.
  std::vector<Body> smaller = bodies;
  for (Body& body : smaller) body.size = tolerated_size(body, tolerance_of(body));
  const OverlapSweep sweep(smaller);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const Wall& wall : system.walls) check_wall(system, wall, i, problems);
    if (const auto& other = sweep.overlapped()[i]) {
      const ExactVector apart = difference(bodies[i].position, bodies[*other].position);
      problems.add(key_of(system, i, "position"), "= [{}, {}]: overlaps {} by {:.3g}",
                   bodies[i].position[0], bodies[i].position[1], name_of(system, *other),
                   shortfall(bodies[i].size + bodies[*other].size, dot(apart, apart)));
    }
  }
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
    const bool is_short = has_short_names(system);
    problems.require_finite(is_short ? "wall.face" : fmt::format("wall {}.point", i + 1),
                            std::max(abs(wall.point[0]), abs(wall.point[1])));
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
  problems.require(system.dimensions == 2 || !are_at_once(system), "contacts",
                   "= at-once: is for discs; blocks collide in order");
  const bool can_move =
      std::ranges::any_of(system.bodies, [](const Body& body) { return body.mass.has_value(); });
  problems.require(can_move, "body", "all have infinite mass: nothing can move");
  if (!problems.empty()) return problems.take();  // what follows would only repeat them
  if (has_short_names(system)) {
    check_places(system, problems);
  } else if (system.dimensions == 1) {
    check_line(system, problems);
  } else {
    check_plane(system, problems);
  }
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
  const auto is_movable = [&](std::size_t id) { return id < count && system.bodies[id].mass; };
  const bool has_immovable = !is_movable(first) || !is_movable(second);
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

bool is_moving(const Wall& wall) { return wall.velocity[0] != 0 || wall.velocity[1] != 0; }

bool is_driven(const System& system) {
  const auto is_moving_body = [](const Body& body) {
    return !body.mass && (body.velocity[0] != 0 || body.velocity[1] != 0);
  };
  return std::ranges::any_of(system.walls, is_moving) ||
         std::ranges::any_of(system.bodies, is_moving_body);
}

}  // namespace piblocks
