#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/run.hpp>

#include <cmath>

#include "physics/blocks.hpp"
#include "physics/body_logs.hpp"

namespace piblocks {

BodyMotion motion_at_start(const BodySystem& system, std::size_t id) {
  const auto rounded = [](const ExactVector& vector) {
    return std::array<double, 2>{to_double(vector[0]), to_double(vector[1])};
  };
  if (id >= system.bodies.size()) {
    return {rounded(system.walls[id - system.bodies.size()].point), {}};
  }
  return {rounded(system.bodies[id].position), rounded(system.bodies[id].velocity)};
}

std::vector<BodyMotion> motions_at_start(const BodySystem& system) {
  std::vector<BodyMotion> motions;
  motions.reserve(system.bodies.size());
  for (std::size_t body = 0; body < system.bodies.size(); ++body) {
    motions.push_back(motion_at_start(system, body));
  }
  return motions;
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

Integer Log::first_since(const Rational& time) const {
  Integer last = count_at(time);
  while (last >= first_index() && collision_time(last) == to_time(time)) --last;
  return last + 1;
}

std::unique_ptr<Log> make_log(const BodySystem& system, const std::optional<Rational>& horizon,
                              const std::stop_token& stop, Engine engine) {
  require_valid(problems_of(system));
  return make_log_of_valid(system, horizon, stop, engine);
}

std::unique_ptr<Log> make_log_of_valid(const BodySystem& system,
                                       const std::optional<Rational>& horizon,
                                       const std::stop_token& stop, Engine engine) {
  if (two_blocks_of(system)) return make_valid_collision_log(system, engine);
  if (horizon) require_not_negative(*horizon);
  return make_stored_body_log(system, horizon, stop, engine);
}

}  // namespace piblocks
