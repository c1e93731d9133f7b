#include "physics/exact_motion.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace piblocks {
namespace {

/// Longest numerator or denominator built to test whether a point lies on a ray, for each bit of
/// the precision that has not decided it. The test then takes no longer than more precision would.
constexpr double kMaxRay_bits = 16;

/// Longest power of a ray's direction, in bits, from which the time of a collision is computed
/// exactly. Longer ones would slow down everything that is computed with that time.
constexpr double kMaxShort_bits = 256;

std::size_t size_bits(const Rational& value) {
  return mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2);
}

/// 1 + i sigma to the power n is A + i sigma B with rational A, B: the direction of ray n.
struct RayDirection {
  Rational a = 1;
  Rational b = 0;

  friend RayDirection multiply(const RayDirection& p, const RayDirection& q, const Rational& r) {
    return {p.a * q.a - r * p.b * q.b, p.a * q.b + p.b * q.a};
  }
};

RayDirection ray_direction(unsigned long n, const Rational& r) {
  RayDirection result;
  RayDirection square{1, 1};
  for (; n != 0; n /= 2) {
    if (n % 2 == 1) result = multiply(result, square, r);
    square = multiply(square, square, r);
  }
  return result;
}

/// Whether (sigma x, y) certainly lies on the line of ray n. False if that takes numbers longer
/// than max_bits.
bool is_on_ray(const Integer& n, const Rational& x, const Rational& y, const Rational& r,
               double max_bits) {
  if (!n.fits_slong_p()) return false;
  const long index = n.get_si();
  if (std::abs(double(index)) * double(size_bits(r)) > max_bits) return false;
  const RayDirection ray = ray_direction(static_cast<unsigned long>(std::labs(index)), r);
  return x * ray.a == (index < 0 ? Rational(-ray.b) : ray.b) * y;
}

/// Splits a phase at its floor, raising the precision until the floor is certain and the rest has a
/// relative error below 2^-relative_bits.
/// `phase(bits)` is right to 2^(magnitude + 6) units of its last place, |phase| < 2^magnitude.
/// (x, y) is a point on its ray, in the frame in which the phase grows.
template <typename Phase>
Asymptote split(const Phase& phase, long magnitude, long relative_bits, const Rational& x,
                const Rational& y, const Rational& r) {
  for (mpfr_prec_t bits = magnitude + 64 + std::max(relative_bits, 64L); bits <= kMaxDecisionBits;
       bits *= 2) {
    const Real value = phase(bits);
    const Real error = scaled(Real(bits, 1), magnitude + 6 - bits);
    const Integer low = (value - error).floor();
    const Integer high = (value + error).floor();
    const bool certain = low == high;
    if (certain) {
      const Real rest = value - low;
      if (rest.exponent() - error.exponent() > relative_bits) return {low, rest};
    }
    if (certain && relative_bits == 0) return {low, value - low};
    if (is_on_ray(high, x, y, r, kMaxRay_bits * double(bits))) return {high, Real(bits, 0)};
  }
  throw SimulationError(fmt::format("count: {} bits do not decide whether a collision has happened",
                                    kMaxDecisionBits));
}

}  // namespace

ExactMotion::ExactMotion(const BlockSystem& system)
    : ratio(system.blue.mass / system.red.mass),
      y1(system.blue_gap()),
      y2(system.blue_gap() + system.blocks_gap()),
      u1(system.blue.velocity),
      u2(system.red.velocity),
      areal_velocity(y2 * u1 - y1 * u2),
      speed_squared(ratio * u1 * u1 + u2 * u2),
      blocks_first(areal_velocity > 0 ||
                   (areal_velocity == 0 && (u1 > u2 || (u1 == u2 && u1 > 0)))) {
  if (!at_rest()) closest_approach = -(ratio * y1 * u1 + y2 * u2) / speed_squared;
}

long ExactMotion::magnitude() const {
  // No phase of interest passes 3 pi/2, and theta >= min(sigma, 1) pi/4.
  return 4 - std::min(sigma(64).exponent(), 0L);
}

Real ExactMotion::final_phase(const Real& sigma, const Real& theta) const {
  const mpfr_prec_t bits = sigma.bits();
  Real angle = atan2(sigma * Real(bits, turned(u1)), Real(bits, u2));
  // A line that turns from the blocks' ray on ends at 0 to pi + theta; a mirrored one, from the
  // wall on, at -theta to pi.
  if (blocks_first && angle.sign() < 0) angle = angle + scaled(Real::pi(bits), 1);
  return angle / theta;
}

Wedge ExactMotion::wedge(mpfr_prec_t bits) const {
  const long size = magnitude();
  Real s(MPFR_PREC_MIN);  // not computed yet
  Real theta(MPFR_PREC_MIN);
  Real q(MPFR_PREC_MIN);
  const auto final = [&](mpfr_prec_t wanted) {
    if (wanted == q.bits()) return q;
    s = sigma(wanted);
    theta = atan(s);
    q = final_phase(s, theta);
    return q;
  };
  Asymptote future = split(final, size, bits, turned(u1), u2, ratio);
  // Backwards in time phases fall: -(q - pi/theta) is what grows.
  const auto first = [&](mpfr_prec_t wanted) {
    final(wanted);
    return Real::pi(wanted) / theta - q;
  };
  Asymptote past = split(first, size, bits, turned(u1), Rational(-u2), ratio);
  past.ray = -past.ray;
  return {s, theta, past, future};
}

template <typename PhaseFunction>
Bracket ExactMotion::bracket(const PhaseFunction& phase, const Rational& x, const Rational& y,
                             mpfr_prec_t bits) const {
  const auto at = [&](mpfr_prec_t wanted) {
    const Real s = sigma(wanted);
    return phase(s, atan(s));
  };
  // Mirrored, phases fall.
  const auto mirrored = [&](mpfr_prec_t wanted) { return Real(wanted, 0) - at(wanted); };
  const long size = magnitude();
  Bracket result{split(at, size, bits, x, y, ratio),
                 split(mirrored, size, bits, Rational(-x), y, ratio)};
  result.above.ray = -result.above.ray;
  return result;
}

Bracket ExactMotion::turn(mpfr_prec_t bits) const {
  const auto phase = [this](const Real& s, const Real& theta) {
    return final_phase(s, theta) - scaled(Real::pi(s.bits()), -1) / theta;
  };
  // At right angles to the line.
  return bracket(phase, Rational(-u2), Rational(ratio * turned(u1)), bits);
}

Bracket ExactMotion::start(mpfr_prec_t bits) const {
  const auto phase = [this](const Real& s, const Real& theta) {
    return atan2(s * Real(s.bits(), turned(y1)), Real(s.bits(), y2)) / theta;
  };
  return bracket(phase, turned(y1), y2, bits);
}

Integer ExactMotion::total(const Asymptote& future) const {
  // A ray that the line only reaches at infinity is not crossed.
  const Integer last = future.beyond.sign() == 0 ? Integer(future.ray - 1) : future.ray;
  const Integer count = count_from_ray(last);
  return count < 0 ? Integer(0) : count;
}

Integer ExactMotion::total() const {
  if (at_rest()) return 0;
  const auto phase = [this](mpfr_prec_t bits) {
    const Real s = sigma(bits);
    return final_phase(s, atan(s));
  };
  return total(split(phase, magnitude(), 0, turned(u1), u2, ratio));
}

Integer ExactMotion::first_index(const Asymptote& past) const {
  const Integer first = past.beyond.sign() == 0 ? Integer(past.ray + 1) : past.ray;
  return std::min<Integer>(count_from_ray(first), 1);
}

std::optional<Rational> ExactMotion::short_crossing(const Integer& ray) const {
  if (!ray.fits_slong_p()) return std::nullopt;
  const long n = ray.get_si();
  if (std::abs(double(n)) * double(size_bits(ratio)) > kMaxShort_bits) return std::nullopt;
  RayDirection direction = ray_direction(static_cast<unsigned long>(std::labs(n)), ratio);
  if (n < 0) direction.b = -direction.b;
  const Rational& a = direction.a;
  const Rational& b = direction.b;
  return Rational((b * y2 - a * turned(y1)) / (a * turned(u1) - b * u2));
}

Rational ExactMotion::rounded_crossing(const Integer& ray, mpfr_prec_t bits) const {
  const Wedge rays = wedge(bits);
  // The angle from the nearer end of time: a sum of two positive numbers.
  const Real from_past = Real(bits, Rational(ray - rays.past.ray)) + rays.past.beyond;
  const Real to_future = Real(bits, Rational(rays.future.ray - ray)) + rays.future.beyond;
  const bool late = (from_past - to_future).sign() > 0;
  const Real angle = (late ? to_future : from_past) * rays.theta;
  const Real passage = rays.sigma * Real(bits, abs(areal_velocity) / speed_squared);
  const Real tau = passage * cot(angle);
  // Each of the few roundings above is at most 2^-bits of the result, or of the passage.
  const Real margin = scaled(tau + passage, 8 - bits);
  Rational since_approach = tau.to_rational();
  if (!late) since_approach = -since_approach;
  const Rational time = closest_approach + since_approach + margin.to_rational();
  // Up to the next multiple of 2^grid, which keeps the number short.
  const long grid = margin.exponent();
  const Rational unit = grid < 0 ? Rational(1 / power(2, static_cast<unsigned long>(-grid)))
                                 : power(2, static_cast<unsigned long>(grid));
  return Rational(ceil(time / unit)) * unit;
}

Rational ExactMotion::time_past(const Integer& ray) const {
  if (const auto crossing = short_crossing(ray)) return *crossing;
  for (mpfr_prec_t bits = 2 * magnitude() + 128; bits <= kMaxDecisionBits; bits *= 2) {
    Rational time = rounded_crossing(ray, bits);
    if (phase_at(time).ray == ray) return time;
  }
  throw SimulationError(
      fmt::format("collision: {} bits do not tell its time from the next one's", kMaxDecisionBits));
}

Phase ExactMotion::phase_at(const Rational& t) const {
  const Rational along = (t - closest_approach) * speed_squared;  // |V|^2 tau
  const auto phase = [&](mpfr_prec_t bits) {
    const Real s = sigma(bits);
    const Real theta = atan(s);
    const Real to_go = atan2(s * Real(bits, abs(areal_velocity)), Real(bits, along));
    return final_phase(s, theta) - to_go / theta;
  };
  const Asymptote at =
      split(phase, magnitude(), 0, turned(y1 + u1 * t), Rational(y2 + u2 * t), ratio);
  return {at.ray, at.beyond.to_double()};
}

}  // namespace piblocks
