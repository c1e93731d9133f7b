#include "physics/impact.hpp"

#include <cmath>

#include "core/two_sum.hpp"
#include "physics/real.hpp"
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

std::optional<Impact> impact(const CollisionLog& log, CollisionKind kind, const Integer& first,
                             const Integer& last) {
  if (const UnfoldedLog* const form = closed_form(log)) return form->impact(kind, first, last);
  const Rational mass_ratio = log.system().blue.mass / log.system().red.mass;
  std::optional<Impact> sum;
  // Means are taken relative to the first collision: a product would lose the second double.
  double delay = 0;
  double shift = 0;
  for (Integer index = first; index <= last; ++index) {
    const Collision collision = log.collision(index);
    if (collision.kind != kind) continue;
    const double impulse = impulse_of(mass_ratio, collision);
    if (!sum) {
      sum = Impact{.kind = kind, .time = collision.time, .blue_position = collision.blue.position};
    }
    sum->impulse += impulse;
    const double share = sum->impulse > 0 ? impulse / sum->impulse : 0;
    const Time& time = collision.time;
    delay += share * ((time.hi - sum->time.hi) + (time.lo - sum->time.lo) - delay);
    shift += share * (collision.blue.position - sum->blue_position - shift);
  }
  if (sum) {
    const Time time = two_sum(sum->time.hi, delay);
    sum->time = two_sum(time.hi, time.lo + sum->time.lo);
    sum->blue_position += shift;
  }
  return sum;
}

Integer count_near(const CollisionLog& log, const Time& time) {
  if (const UnfoldedLog* const form = closed_form(log)) return form->count_near(time);
  return log.state_at(to_rational(time)).count;
}

}  // namespace piblocks
