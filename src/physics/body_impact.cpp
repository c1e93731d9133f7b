#include <piblocks/contact.hpp>
#include <piblocks/log.hpp>

#include <cmath>

#include "core/real.hpp"
#include "physics/body_logs.hpp"
#include "physics/impact.hpp"

namespace piblocks {
namespace {

/// The impulse that a body of mean mass would get if it met a wall at the mean speed. Sums have
/// more bits than are seen: those of exact fractions would grow with the number of bodies.
double usual_impulse(const BodySystem& system) {
  constexpr mpfr_prec_t kPrecision_bits = 256;
  Real mass(kPrecision_bits, 0);
  Real twice_energy(kPrecision_bits, 0);
  unsigned long movable = 0;
  for (const Body& body : system.bodies) {
    if (!body.mass) continue;
    const auto& [x, y] = body.velocity;
    mass = mass + Real(kPrecision_bits, *body.mass);
    twice_energy = twice_energy + Real(kPrecision_bits, *body.mass * (x * x + y * y));
    ++movable;
  }
  return 2 * std::sqrt((mass * twice_energy).to_double()) / double(movable);
}

/// Where a body or a wall touches the first body of a collision, seen from that body's centre.
std::array<double, 2> way_to(const BodySystem& system, const BodyCollision& collision) {
  const auto& from = collision.first_after.position;
  const auto& to = collision.second_after.position;
  if (collision.second < system.bodies.size()) return {to[0] - from[0], to[1] - from[1]};
  const ExactVector& normal = system.walls[collision.second - system.bodies.size()].normal;
  return {-to_double(normal[0]), -to_double(normal[1])};
}

/// Both velocities along the line between them are reversed as seen from their common centre of
/// mass, so that what they are afterwards says how large the impulse was.
double impulse_of(const BodySystem& system, const BodyCollision& collision) {
  const auto mass = [&](std::uint32_t id) -> std::optional<double> {
    if (id >= system.bodies.size() || !system.bodies[id].mass) return std::nullopt;
    return to_double(*system.bodies[id].mass);
  };
  const std::array<double, 2> way = way_to(system, collision);
  const double length = std::sqrt(way[0] * way[0] + way[1] * way[1]);
  const auto& u = collision.first_after.velocity;
  const auto& v = collision.second_after.velocity;
  const double speed =
      std::fabs((v[0] - u[0]) * way[0] + (v[1] - u[1]) * way[1]) / (length > 0 ? length : 1);
  std::optional<double> own = mass(collision.first);
  std::optional<double> other = mass(collision.second);
  if (!own) std::swap(own, other);
  return *own * velocity_change(speed, share_of_change(own, other));
}

bool is_at_wall(const BodySystem& system, const BodyCollision& collision) {
  const auto is_fixed = [&](std::uint32_t id) {
    return id >= system.bodies.size() || !system.bodies[id].mass;
  };
  return is_fixed(collision.first) || is_fixed(collision.second);
}

}  // namespace

std::optional<Impact> Log::impact(CollisionKind kind, const Integer& first,
                                  const Integer& last) const {
  std::optional<Impact> sum;
  for (Integer index = first; index <= last; ++index) {
    const BodyCollision found = collision(index);
    if ((kind == CollisionKind::wall) != is_at_wall(system(), found)) continue;
    const bool is_first_fixed = !system().bodies[found.first].mass;
    const BodyMotion& seen = is_first_fixed ? found.second_after : found.first_after;
    if (!sum) sum = Impact{kind, found.time, 0, seen.position[0]};
    sum->impulse += impulse_of(system(), found);
  }
  return sum;
}

double impulse_unit(const Log& log) {
  const double usual = log.pair() ? 0 : usual_impulse(log.system());
  return usual > 0 ? usual : 1;
}

}  // namespace piblocks
