#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>
#include <piblocks/log.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>

#include "bodies/contest.hpp"
#include "bodies/line_loop.hpp"
#include "bodies/tables.hpp"

namespace piblocks::benchmark {
namespace {

/// As assets/scenes/three-blocks.toml.
System three_blocks() {
  System system;
  system.bodies = {{1, {1}, {1}, 1}, {16, {4}, {0}, Rational(3, 2)}, {100, {8}, {-1}, 2}};
  system.walls = {{"left", {0}, {1}}, {"right", {12}, {-1}}};
  return system;
}

std::vector<double> line_positions(const System& system, const std::vector<Rational>& instants) {
  const std::unique_ptr<Log> log = make_log(system, instants.back());
  std::vector<double> positions;
  for (const Rational& time : instants) {
    for (const Motion& body : log->state_at(time).bodies) {
      positions.push_back(body.position[0]);
    }
  }
  return positions;
}

/// Walls are immovable blocks, one wide.
template <typename Number>
std::vector<Particle<Number, 1>> particles_of(const System& system) {
  std::vector<Particle<Number, 1>> particles;
  const auto add = [&](const Number& mass, const Rational& size, const Rational& position,
                       const Rational& velocity) {
    Particle<Number, 1> particle;
    particle.mass = mass;
    particle.radius = to_number<Number>(size / 2);
    particle.position[0] = to_number<Number>(position);
    particle.velocity[0] = to_number<Number>(velocity);
    particles.push_back(particle);
  };
  for (const Body& body : system.bodies) {
    add(to_number<Number>(*body.mass), body.size, body.position[0], body.velocity[0]);
  }
  for (const Wall& wall : system.walls) {
    add(kInfiniteMass<Number>, 1, wall.point[0] - wall.normal[0] / 2, 0);
  }
  return particles;
}

template <typename Number>
std::vector<Number> simulated_line_positions(const System& system,
                                             const std::vector<double>& instants) {
  EventSimulator<Number, 1> simulator(particles_of<Number>(system));
  std::vector<Number> positions;
  for (const double instant : instants) {
    const Number time(instant);
    while (*simulator.next_time() <= time) simulator.step();
    const auto particles = simulator.particles_at(time);
    for (std::size_t i = 0; i < system.bodies.size(); ++i) {
      positions.push_back(particles[i].position[0]);
    }
  }
  return positions;
}

double worst_error(const Answers& answers, const Answers& right) {
  Wide worst = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    worst = std::max(worst, Wide(abs(answers[i] - right[i])));
  }
  return static_cast<double>(worst);
}

/// A time between this collision and the next.
double time_after_blocks(const System& system, int collisions) {
  LineLoop<Wide> loop(system);
  for (int k = 1; k < collisions; ++k) loop.step();
  const Wide last = loop.next_time();
  loop.step();
  return static_cast<double>(Wide((last + loop.next_time()) / 2));
}

/// Rational numbers grow too long for thousands of collisions. While they do not, they are what 400
/// bits have to agree with.
Answers right_line_positions(const System& system, const std::vector<double>& instants,
                             int collisions) {
  Answers right = loop_positions<Wide>(system, instants);
  constexpr int kMostExact = 500;
  if (collisions > kMostExact) return right;
  Answers exact;
  for (const Rational& position : loop_positions<Rational>(system, instants)) {
    exact.push_back(to_wide(position));
  }
  if (worst_error(right, exact) > 1e-100) {
    throw SimulationError(fmt::format(
        "blocks on a line: {} collisions in 400 bits are not those in rational numbers: either "
        "program is wrong",
        collisions));
  }
  return exact;
}

std::vector<Contestant> line_contestants(const System& system,
                                         const std::vector<double>& instants) {
  const std::vector<Rational> exact(instants.begin(), instants.end());
  std::vector<Contestant> all = {contestant("piblocks::Log", "rational, then double",
                                            [=] { return line_positions(system, exact); })};
  const auto add = [&]<typename Number>(Number) {
    all.push_back(contestant("piblocks::EventSimulator", kNumberName<Number>,
                             [=] { return simulated_line_positions<Number>(system, instants); }));
    all.push_back(contestant("plain loop", kNumberName<Number>,
                             [=] { return loop_positions<Number>(system, instants); }));
  };
  add(0.0);
  add(0.0L);
  add(Decimal50(0));
  return all;
}

/// Times and errors of all contestants, for one number of collisions.
struct LineColumn {
  std::vector<Contestant> contestants;
  std::vector<double> errors = {};
};

LineColumn line_column(const System& system, int collisions) {
  const std::vector<double> instants =
      random_instants(time_after_blocks(system, collisions), kInstants);
  const Answers right = right_line_positions(system, instants, collisions);
  LineColumn column{line_contestants(system, instants)};
  for (const Contestant& contestant : column.contestants) {
    column.errors.push_back(worst_error(contestant.reply(), right));
  }
  time_all(column.contestants);
  return column;
}

void print_line_certainty(const System& system) {
  constexpr std::int64_t kEnough = 500'000;
  const std::unique_ptr<Log> log = make_log(system);
  std::int64_t exact = 0;
  while (log->is_exact(to_integer(exact + 1))) ++exact;
  fmt::print("\nThe log computes {} collisions exactly. ", readable(to_integer(exact)));
  for (Rational until = 1000;; until *= 4) {
    const std::optional<double> end = log->certain_until(until);
    const Integer count = log->count_at(end ? Rational(*end) : until);
    if (!end && count < kEnough) continue;
    fmt::print("It is certain {} {}.\n\n", end ? "until collision" : "at least until collision",
               readable(count));
    return;
  }
}

}  // namespace

void print_line_table() {
  const System system = three_blocks();
  std::vector<LineColumn> columns;
  std::string head = "| Method | Number type |";
  std::string rule = "|---|---|";
  for (const int collisions : {50, 500, 5000}) {
    columns.push_back(line_column(system, collisions));
    head += fmt::format(" {} collisions: time | error |", readable(collisions));
    rule += "---:|---:|";
  }
  fmt::print("{}\n{}\n", head, rule);
  for (std::size_t row = 0; row < columns[0].contestants.size(); ++row) {
    const Contestant& contestant = columns[0].contestants[row];
    fmt::print("| {} | {} |", contestant.method, contestant.number);
    for (const LineColumn& column : columns) {
      fmt::print(" {} | {} |", time_text(column.contestants[row]), error_text(column.errors[row]));
    }
    fmt::print("\n");
  }
  print_line_certainty(system);
}

}  // namespace piblocks::benchmark
