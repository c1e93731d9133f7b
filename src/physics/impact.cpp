#include "physics/impact.hpp"

#include "core/real.hpp"
#include "core/two_sum.hpp"
#include "physics/inelastic_log.hpp"
#include "physics/unfolded_log.hpp"

namespace piblocks {
namespace {

/// In the unit of Impact. Exact up to one root: masses can be beyond the range of a double.
double impulse_of(const Rational& mass_ratio, const Collision& collision) {
  constexpr mpfr_prec_t kPrecision_bits = 64;
  const Rational blue(collision.blue.velocity);
  const Rational red(collision.red.velocity);
  const Rational change = collision.kind == CollisionKind::wall ? Rational((1 + mass_ratio) * blue)
                                                                : Rational(red - blue);
  const Rational speed_squared = mass_ratio * blue * blue + red * red;
  return sqrt(Real(kPrecision_bits, change * change / speed_squared)).to_double();
}

}  // namespace

std::optional<Impact> UnfoldedLog::blocks_impact(CollisionKind kind, const Integer& first,
                                                 const Integer& last) const {
  const bool odd = kind == CollisionKind::blocks;
  Integer from = ray_of(first);
  Integer to = ray_of(last);
  if (is_odd(from) != odd) ++from;
  if (is_odd(to) != odd) --to;
  if (from > to) return std::nullopt;
  const RayView seen = view_of(from, to);
  // The impulse of a collision in the middle, times sin(n theta)/sin theta (README.md, "Many
  // collisions as one").
  const double one = seen.ray.sine / form_.step.sine / (odd ? 1 : form_.step.cosine);
  double number = 1;
  if (from != to) {
    const Integer n = (to - from) / 2 + 1;
    number = form_.direction(to_time(Rational(n)), {}).sine / form_.step.sine;
  }
  const double reach = form_.kind(odd).blue_reach * (form_.sigma / seen.ray.sine);
  return Impact{kind, time(from, to, seen), one * number, form_.blue_offset + reach * form_.ell};
}

Integer UnfoldedLog::count_near(const Time& time) const {
  LinePoint point = point_at(tau_near(time), time);
  point.decided = true;
  const Rational exact = exact_.through_corner() ? to_rational(time) : Rational(0);
  return exact_.count_from_ray(phase_of(point, exact).ray);
}

std::optional<Impact> CollisionLog::impact(CollisionKind kind, const Integer& first,
                                           const Integer& last) const {
  std::optional<Impact> sum = blocks_impact(kind, first, last);
  if (sum) sum->position *= blocks().side;
  return sum;
}

std::optional<Impact> CollisionLog::blocks_impact(CollisionKind kind, const Integer& first,
                                                  const Integer& last) const {
  const Rational mass_ratio = blocks().blue.mass / blocks().red.mass;
  std::optional<Impact> sum;
  // Means are taken relative to the first collision: a product would lose the second double.
  double delay = 0;
  double shift = 0;
  for (Integer index = first; index <= last; ++index) {
    const Collision collision = blocks_collision(index);
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

}  // namespace piblocks
