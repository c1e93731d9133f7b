#include "physics/impact.hpp"

#include <cmath>
#include <utility>

#include "core/real.hpp"
#include "core/two_sum.hpp"

namespace piblocks {
namespace {

/// In the unit of Impact. Exact up to one root: masses can be beyond the range of a double.
double impulse_of(const Rational& mass_ratio, const PairCollision& collision) {
  constexpr mpfr_prec_t kPrecision_bits = 64;
  const Rational blue(collision.blue.velocity);
  const Rational red(collision.red.velocity);
  const Rational change = collision.kind == CollisionKind::wall ? Rational((1 + mass_ratio) * blue)
                                                                : Rational(red - blue);
  const Rational speed_squared = mass_ratio * blue * blue + red * red;
  return sqrt(Real(kPrecision_bits, change * change / speed_squared)).to_double();
}

/// From the velocities of the lighter one: the change of the other may be lost in rounding.
double impulse_of(const System& system, const Collision& collision) {
  const auto mass = [&](std::uint32_t id) {
    return is_immovable(system, id) ? HUGE_VAL : to_double(*system.bodies[id].mass);
  };
  const bool is_first = mass(collision.first) <= mass(collision.second);
  const auto& before = is_first ? collision.first_before : collision.second_before;
  const auto& after = (is_first ? collision.first_after : collision.second_after).velocity;
  const double x = after[0] - before[0];
  const double y = after[1] - before[1];
  const double change = y == 0 ? std::fabs(x) : std::sqrt(x * x + y * y);
  return mass(is_first ? collision.first : collision.second) * change;
}

}  // namespace

std::optional<Impact> PairLog::impact(CollisionKind kind, const Integer& first,
                                      const Integer& last) const {
  std::optional<Impact> sum = blocks_impact(kind, first, last);
  if (!sum) return sum;
  const double to_red = blocks().side * to_double(blocks().blue.width) / 2;
  sum->position = blocks().side * sum->position + (kind == CollisionKind::wall ? -to_red : to_red);
  return sum;
}

std::optional<Impact> PairLog::blocks_impact(CollisionKind kind, const Integer& first,
                                             const Integer& last) const {
  const Rational mass_ratio = blocks().blue.mass / blocks().red.mass;
  std::optional<Impact> sum;
  // Means are taken relative to the first collision: a product would lose the second double.
  double delay = 0;
  double shift = 0;
  for (Integer index = first; index <= last; ++index) {
    const PairCollision collision = blocks_collision(index);
    if (collision.kind != kind) continue;
    const double impulse = impulse_of(mass_ratio, collision);
    if (!sum) {
      sum = Impact{.kind = kind, .time = collision.time, .position = collision.blue.position};
    }
    sum->impulse += impulse;
    const double share = sum->impulse > 0 ? impulse / sum->impulse : 0;
    const Time& time = collision.time;
    delay += share * ((time.hi - sum->time.hi) + (time.lo - sum->time.lo) - delay);
    shift += share * (collision.blue.position - sum->position - shift);
  }
  if (sum) {
    const Time time = two_sum(sum->time.hi, delay);
    sum->time = two_sum(time.hi, time.lo + sum->time.lo);
    sum->position += shift;
  }
  return sum;
}

std::optional<Impact> Log::impact(CollisionKind kind, const Integer& first,
                                  const Integer& last) const {
  std::optional<Impact> sum;
  for (Integer index = first; index <= last; ++index) {
    const Collision found = collision(index);
    const bool is_first_fixed = is_immovable(system(), found.first);
    const bool is_at_wall = is_first_fixed || is_immovable(system(), found.second);
    if ((kind == CollisionKind::wall) != is_at_wall) continue;
    const Motion& seen = is_first_fixed ? found.second_after : found.first_after;
    if (!sum) sum = Impact{kind, found.time, 0, seen.position[0]};
    sum->impulse += impulse_of(system(), found);
  }
  return sum;
}

/// Sums have more bits than are seen: those of exact fractions would grow with the number of
/// bodies.
double Log::impulse_unit() const {
  constexpr mpfr_prec_t kPrecision_bits = 256;
  Real mass(kPrecision_bits, 0);
  Real twice_energy(kPrecision_bits, 0);
  unsigned long movable = 0;
  for (const Body& body : system().bodies) {
    if (!body.mass) continue;
    const auto& [x, y] = body.velocity;
    mass = mass + Real(kPrecision_bits, *body.mass);
    twice_energy = twice_energy + Real(kPrecision_bits, *body.mass * (x * x + y * y));
    ++movable;
  }
  const double usual = 2 * std::sqrt((mass * twice_energy).to_double()) / double(movable);
  return usual > 0 ? usual : 1;
}

}  // namespace piblocks
