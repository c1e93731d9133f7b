#include "physics/exact_motion.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cmath>
#include <optional>

#include "core/two_sum.hpp"

namespace piblocks {
namespace {

/// Longest numerator or denominator built to test whether a point lies on a ray, for each bit of
/// the precision that has not decided it. The test then takes no longer than more precision would.
constexpr double kMaxRay_bits = 16;

/// 1 + i sigma to the power n is A + i sigma B with rational A, B: the direction of ray n.
struct RayDirection {
  Rational a = 1;
  Rational b = 0;
};

RayDirection multiply(const RayDirection& p, const RayDirection& q, const Rational& r) {
  return {p.a * q.a - r * p.b * q.b, p.a * q.b + p.b * q.a};
}

/// Nothing if that may take numbers longer than max_bits.
std::optional<RayDirection> ray_direction(const Integer& n, const Rational& r, double max_bits) {
  if (std::fabs(n.get_d()) * double(size_bits(r)) > max_bits) return std::nullopt;
  RayDirection result;
  RayDirection square{1, n < 0 ? -1 : 1};
  for (unsigned long left = Integer(abs(n)).get_ui(); left != 0; left /= 2) {
    if (left % 2 == 1) result = multiply(result, square, r);
    square = multiply(square, square, r);
  }
  return result;
}

}  // namespace

Landmark::Landmark(const Asymptote& asymptote, int side)
    : ray(asymptote.ray), beyond(asymptote.beyond.to_double_double()), sign(side) {}

DoubleDouble Landmark::steps_from(const Integer& other) const {
  constexpr long kNoOverflow = 1L << 62;
  if (mpz_cmpabs_ui(ray.get_mpz_t(), kNoOverflow) < 0 &&
      mpz_cmpabs_ui(other.get_mpz_t(), kNoOverflow) < 0) {  // a shortcut
    const long steps = sign * (ray.get_si() - other.get_si());
    const auto rounded = static_cast<double>(steps >> 11 << 11);
    return two_sum(rounded, static_cast<double>(steps & 2047));
  }
  const Integer steps = sign > 0 ? Integer(ray - other) : Integer(other - ray);
  if (const auto exact = exact_double(steps)) return {*exact, 0};
  return to_time(Rational(steps));
}

ExactMotion::ExactMotion(const TwoBlocks& system)
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
  Real angle = atan2(sigma * Real(bits, mirrored(u1)), Real(bits, u2));
  // A line that turns from the blocks' ray on ends at 0 to pi + theta; a mirrored one, from the
  // wall on, at -theta to pi.
  if (blocks_first && angle.sign() < 0) angle = angle + scaled(Real::pi(bits), 1);
  return angle / theta;
}

template <typename PhaseFunction>
Asymptote ExactMotion::split(const PhaseFunction& phase, const Rational& x, const Rational& y,
                             long relative_bits) const {
  const long size = magnitude();
  for (mpfr_prec_t bits = first_precision(relative_bits); bits <= kMaxDecisionBits; bits *= 2) {
    const Real s = sigma(bits);
    const Real value = phase(s, atan(s));
    const Real error = scaled(Real(bits, 1), size + 6 - bits);
    const Integer low = (value - error).floor();
    const Integer high = (value + error).floor();
    if (low == high) {
      const Real rest = value - low;
      const bool is_exact = rest.exponent() - error.exponent() > relative_bits;
      if (is_exact || relative_bits == 0) return {low, rest};
    }
    const auto ray = ray_direction(high, ratio, kMaxRay_bits * double(bits));
    if (ray && x * ray->a == ray->b * y) return {high, Real(bits, 0)};  // certainly on it
  }
  throw SimulationError(fmt::format("count: {} bits do not decide whether a collision has happened",
                                    kMaxDecisionBits));
}

Asymptote ExactMotion::future(long relative_bits) const {
  const auto phase = [this](const Real& s, const Real& theta) { return final_phase(s, theta); };
  return split(phase, mirrored(u1), u2, relative_bits);
}

Wedge ExactMotion::wedge(mpfr_prec_t bits) const {
  // Backwards in time phases fall: -(q - pi/theta) is what grows.
  const auto first = [this](const Real& s, const Real& theta) {
    return Real::pi(s.bits()) / theta - final_phase(s, theta);
  };
  Asymptote past = split(first, mirrored(u1), Rational(-u2), bits);
  past.ray = -past.ray;
  const Real s = sigma(first_precision(bits));
  return {s, atan(s), past, future(bits)};
}

template <typename PhaseFunction>
TwoSided ExactMotion::two_sided(const PhaseFunction& phase, const Rational& x,
                                const Rational& y) const {
  // Mirrored, phases fall.
  const auto mirrored = [&](const Real& s, const Real& theta) {
    return Real(s.bits(), 0) - phase(s, theta);
  };
  Asymptote above = split(mirrored, Rational(-x), y, kLandmark_bits);
  above.ray = -above.ray;
  return {{split(phase, x, y, kLandmark_bits), +1}, {above, -1}};
}

TwoSided ExactMotion::turn() const {
  const auto phase = [this](const Real& s, const Real& theta) {
    return final_phase(s, theta) - scaled(Real::pi(s.bits()), -1) / theta;
  };
  // At right angles to the line.
  return two_sided(phase, Rational(-u2), Rational(ratio * mirrored(u1)));
}

TwoSided ExactMotion::start() const {
  const auto phase = [this](const Real& s, const Real& theta) {
    return atan2(s * Real(s.bits(), mirrored(y1)), Real(s.bits(), y2)) / theta;
  };
  return two_sided(phase, mirrored(y1), y2);
}

Integer ExactMotion::total(const Asymptote& future) const {
  // A ray that the line only reaches at infinity is not crossed.
  const Integer last = future.beyond.sign() == 0 ? Integer(future.ray - 1) : future.ray;
  return std::max<Integer>(count_from_ray(last), 0);
}

Integer ExactMotion::total() const { return at_rest() ? Integer(0) : total(future(0)); }

Integer ExactMotion::first_index(const Asymptote& past) const {
  const Integer first = past.beyond.sign() == 0 ? Integer(past.ray + 1) : past.ray;
  return std::min<Integer>(count_from_ray(first), 1);
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
  const Rational unit = scaled(Real(64, 1), grid).to_rational();
  return Rational(ceil(time / unit)) * unit;
}

Rational ExactMotion::time_past(const Integer& ray) const {
  if (const auto direction = ray_direction(ray, ratio, kShortTime_bits)) {
    const auto& [a, b] = *direction;
    return (b * y2 - a * mirrored(y1)) / (a * mirrored(u1) - b * u2);
  }
  for (mpfr_prec_t bits = 2 * magnitude() + 128; bits <= kMaxDecisionBits; bits *= 2) {
    Rational time = rounded_crossing(ray, bits);
    if (phase_at(time).ray == ray) return time;
  }
  throw SimulationError(
      fmt::format("collision: {} bits do not tell its time from the next one's", kMaxDecisionBits));
}

Real ExactMotion::phase(const Rational& along, const Real& sigma, const Real& theta) const {
  const mpfr_prec_t bits = sigma.bits();
  const Real to_go = atan2(sigma * Real(bits, abs(areal_velocity)), Real(bits, along));
  return final_phase(sigma, theta) - to_go / theta;
}

Phase ExactMotion::phase_at(const Rational& t) const {
  const Rational along = (t - closest_approach) * speed_squared;
  const auto rising = [&](const Real& s, const Real& theta) { return phase(along, s, theta); };
  const Asymptote at = split(rising, mirrored(y1 + u1 * t), Rational(y2 + u2 * t), 0);
  return {at.ray, at.beyond.to_double()};
}

double ExactMotion::phase_from_wall(const Rational& t) const {
  constexpr long kBits = 60;
  const Rational along = (t - closest_approach) * speed_squared;
  const Rational x = mirrored(y1 + u1 * t);
  const Rational y = y2 + u2 * t;
  const auto rising = [&](const Real& s, const Real& theta) { return phase(along, s, theta); };
  const Asymptote last = split(rising, x, y, kBits);
  if (!is_odd(last.ray)) return last.beyond.to_double();
  const Real to_next = Real(last.beyond.bits(), 1) - last.beyond;
  // split() is right to 2^-120, so that nothing is lost here unless the next ray is very near.
  if (to_next.exponent() > -kBits) return to_next.to_double();
  const auto falling = [&](const Real& s, const Real& theta) {
    return Real(s.bits(), 0) - phase(along, s, theta);
  };
  return split(falling, Rational(-x), y, kBits).beyond.to_double();
}

}  // namespace piblocks
