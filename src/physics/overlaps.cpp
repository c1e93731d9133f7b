#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <vector>

#include "physics/problems.hpp"

namespace piblocks {
namespace {

ExactVector difference(const ExactVector& a, const ExactVector& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

/// reach - sqrt(square), without cancellation.
double shortfall(const Rational& reach, const Rational& square) {
  const Rational share = square / Rational(reach * reach);
  return to_double(reach) * to_double(Rational(1 - share)) / (1 + std::sqrt(to_double(share)));
}

/// How far a body may overlap what it touches, as a share of its coordinates: a few roundings.
/// Numbers rounded to doubles, or to as many decimals, cannot say touching more exactly.
constexpr double kTolerance = 0x1p-50;

Rational tolerance_of(const Body& body) {
  return Rational(kTolerance) * (abs(body.position[0]) + abs(body.position[1]) + body.size);
}
Rational tolerance_of(const Wall& wall) {
  return Rational(kTolerance) * (abs(wall.point[0]) + abs(wall.point[1]));
}
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

}  // namespace

void check_overlaps(const System& system, SceneProblems& problems) {
  if (has_short_names(system)) {
    check_places(system, problems);
  } else if (system.dimensions == 1) {
    check_line(system, problems);
  } else {
    check_plane(system, problems);
  }
}

}  // namespace piblocks
