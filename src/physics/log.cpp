#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <cmath>

#include "physics/logs.hpp"
#include "physics/problems.hpp"

namespace piblocks {

Motion motion_at_start(const System& system, std::size_t id) {
  const auto rounded = [](const ExactVector& vector) {
    return std::array<double, 2>{to_double(vector[0]), to_double(vector[1])};
  };
  if (id >= system.bodies.size()) {
    const Wall& wall = system.walls[id - system.bodies.size()];
    return {rounded(wall.point), rounded(wall.velocity)};
  }
  return {rounded(system.bodies[id].position), rounded(system.bodies[id].velocity)};
}

std::string noun_of(const System& system, std::size_t id) {
  const std::size_t count = system.bodies.size();
  return id < count ? name_of(system, id) : "the " + noun_of(system.walls[id - count]);
}

namespace {

/// As in "body 1, body 2 and the left wall"; of many, the first ones.
std::string list_of(const System& system, const std::vector<std::uint32_t>& ids) {
  constexpr std::size_t kMostNamed = 5;
  const std::size_t named = ids.size() > kMostNamed ? kMostNamed - 1 : ids.size() - 1;
  std::string list;
  for (std::size_t i = 0; i < named; ++i) {
    list += (i > 0 ? ", " : "") + noun_of(system, ids[i]);
  }
  return list + " and " +
         (named + 1 == ids.size() ? noun_of(system, ids.back())
                                  : fmt::format("{} more", ids.size() - named));
}

}  // namespace

std::string text_of(const System& system, const Collapse& collapse) {
  if (!collapse.time) return "infinitely many collisions, which never end";
  const double end = collapse.time->hi;
  if (two_blocks_of(system)) {
    return fmt::format("infinitely many collisions until the blocks come to rest at t = {}", end);
  }
  return fmt::format("infinitely many collisions of {} until t = {}",
                     list_of(system, collapse.bodies), end);
}

void refuse_count(const System& system, const Collapse& collapse) {
  const double until = collapse.time ? collapse.time->hi * 0.999 : 10;
  throw UsageError(fmt::format("count: there are {}; count those until {} time, as --to {:.4g}",
                               text_of(system, collapse), collapse.time ? "an earlier" : "a",
                               until));
}

std::vector<Motion> motions_at_start(const System& system) {
  std::vector<Motion> motions;
  motions.reserve(system.bodies.size());
  for (std::size_t body = 0; body < system.bodies.size(); ++body) {
    motions.push_back(motion_at_start(system, body));
  }
  return motions;
}

void require_finite(const Time& time, const BlockMotion& blue, const BlockMotion& red,
                    const char* engine) {
  for (const double number : {time.hi, blue.position, blue.velocity, red.position, red.velocity}) {
    if (std::isfinite(number)) continue;
    throw SimulationError(
        fmt::format("{}: a time, position or velocity is beyond the range of a double (about "
                    "1.8e308)",
                    engine));
  }
}

TiedCollision::TiedCollision(const Integer& index, Integer last)
    : UsageError(fmt::format(
          "collision #{}: happens at the same time as all up to #{}; name the last of them",
          index.get_str(), last.get_str())),
      last_(std::move(last)) {}

void require_last(const Integer& index, const Integer& last_at_its_time) {
  if (index != last_at_its_time) throw TiedCollision(index, last_at_its_time);
}

void require_not_negative(const Rational& time) {
  if (time >= 0) return;
  throw UsageError(
      fmt::format("time {}: the motion of bodies begins at time 0; give a later time", time));
}

std::vector<double> sample_times(std::size_t count) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  std::vector<double> times = {0};
  for (std::size_t part = 0; part + 2 < count; ++part) {
    const double turns = double(part + 1) * kGoldenRatio;
    times.push_back((double(part) + turns - std::floor(turns)) / double(count - 2));
  }
  times.push_back(1);
  return times;
}

bool Log::is_listed(const Integer& index) const {
  if (horizon()) return index >= first_index() && index <= last();
  return has(index);
}

std::optional<std::vector<double>> Log::position_bounds(const Rational& /*time*/) const {
  return std::nullopt;
}

Integer Log::first_since(const Rational& time) const {
  Integer last = count_at(time);
  while (last >= first_index() && collision_time(last) == to_time(time)) --last;
  return last + 1;
}

std::unique_ptr<Log> make_log(const System& system, const std::optional<Rational>& horizon,
                              const std::stop_token& stop, Engine engine) {
  require_valid(problems_of(system));
  return make_log_of_valid(system, horizon, stop, engine);
}

std::unique_ptr<Log> make_log_of_valid(const System& system, const std::optional<Rational>& horizon,
                                       const std::stop_token& stop, Engine engine) {
  if (horizon) require_not_negative(*horizon);
  if (two_blocks_of(system)) return make_valid_pair_log(system, engine);
  return make_stepped_log(system, horizon, stop, engine);
}

Integer count_collisions(const System& system, const std::optional<Rational>& horizon) {
  if (horizon) require_not_negative(*horizon);
  const std::optional<TwoBlocks> blocks = two_blocks_of(system);
  if (blocks) return count_collisions(*blocks);
  const auto log = make_log(system, horizon);
  Integer last = log->last();
  if (const auto collapse = log->collapse({})) refuse_count(system, *collapse);
  return last;
}

std::optional<Rational> turn_of(const Log& log) {
  return log.pair() ? turn_of(log.pair()->blocks()) : std::nullopt;
}

}  // namespace piblocks
