#include <fmt/format.h>
#include <piblocks/bodies.hpp>
#include <piblocks/error.hpp>

#include <cmath>

#include "physics/blocks.hpp"
#include "physics/body_logs.hpp"

namespace piblocks {

std::vector<BodyMotion> motions_at_start(const BodySystem& system) {
  std::vector<BodyMotion> motions;
  motions.reserve(system.bodies.size());
  for (const Body& body : system.bodies) {
    motions.push_back({{to_double(body.position[0]), to_double(body.position[1])},
                       {to_double(body.velocity[0]), to_double(body.velocity[1])}});
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

std::unique_ptr<BodyLog> make_body_log(const BodySystem& system,
                                       const std::optional<Rational>& until) {
  if (until) require_not_negative(*until);
  if (auto log = make_closed_body_log(system)) return log;
  if (!until && may_never_end(system)) {
    throw UsageError(
        "time.to: bodies between walls may collide for ever; say until when, as time.to = 10");
  }
  return make_stored_body_log(system, until);
}

}  // namespace piblocks
