#include "physics/unfolded_log.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace piblocks {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

bool is_odd(const Integer& n) { return mpz_odd_p(n.get_mpz_t()) != 0; }

Rational scaled(const Rational& value, long exponent) {
  Rational result;
  if (exponent >= 0) {
    mpq_mul_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return result;
}

double scaled(double value, long exponent) { return std::scalbln(value, exponent); }

void require_finite(const FreeFlight& flight) {
  for (const double number : {flight.anchor.hi, flight.blue.position, flight.blue.velocity,
                              flight.red.position, flight.red.velocity}) {
    if (std::isfinite(number)) continue;
    throw SimulationError("closed form: a time, position or velocity is beyond a double's range");
  }
}

}  // namespace

UnfoldedLog::UnfoldedLog(const BlockSystem& system) : exact_(system), size_(exact_.total()) {
  const long ratio_exponent = std::labs(Real(64, exact_.ratio).exponent());
  if (ratio_exponent > kMaxRatioExponent) {
    throw UsageError(fmt::format(
        "masses: the ratio is beyond 2^{}; positions can be computed up to it, the count alone "
        "at any size",
        kMaxRatioExponent));
  }
  if (exact_.through_corner()) {
    ray_before_corner_ = exact_.ray_before_corner();
    ray_after_corner_ = ray_of(size_);
  }
  const mpfr_prec_t bits = 192 + ratio_exponent;
  const Real sigma = exact_.sigma(bits);
  const Real theta = atan(sigma);
  const Real speed = sqrt(Real(bits, exact_.speed_squared));
  const Real future = exact_.final_phase(sigma, theta);
  const Real past = future - Real::pi(bits) / theta;
  future_ = {future.floor(), (future - future.floor()).to_double(), +1};
  past_ = {past.floor(), (past - past.floor()).to_double(), -1};

  time_exponent_ = -speed.exponent();
  sigma_ = sigma.to_double();
  theta_ = theta.to_double();
  impact_ = (sigma * Real(bits, abs(exact_.area)) / speed).to_double();
  speed_ = scaled(speed, time_exponent_).to_double();
  closest_approach_ = to_time(scaled(exact_.closest_approach, -time_exponent_));
  blue_offset_ = to_double(system.wall_face + system.blue.width / 2);
  red_offset_ = to_double(system.wall_face + system.blue.width + system.red.width / 2);
}

UnfoldedLog::Sighting UnfoldedLog::sight(const Rational& time) const {
  // The difference is exact: far from the start two doubles would not hold a time near the turn.
  Sighting seen;
  seen.tau = to_double(scaled(Rational(time - exact_.closest_approach), -time_exponent_));
  const double along = speed_ * seen.tau;
  seen.distance = std::hypot(impact_, along);
  seen.end = seen.tau < 0 ? &past_ : &future_;
  const double to_go = std::atan2(impact_, std::fabs(along)) / theta_;
  seen.phase = seen.end->fraction - seen.end->sign * to_go;

  // Seven roundings in to_go and two in the sum.
  const double error = 8 * kUnitRoundoff * (to_go + 1);
  seen.decided = std::floor(seen.phase - error) == std::floor(seen.phase + error);
  return seen;
}

DecidedPhase UnfoldedLog::decide(const Sighting& seen, const Rational& time) const {
  if (exact_.through_corner()) {
    const Integer& ray = time < exact_.closest_approach ? ray_before_corner_ : ray_after_corner_;
    return {ray, Integer(seen.end->whole - ray).get_d() + seen.end->fraction};
  }
  if (!seen.decided) return exact_.phase_at(time);
  const double whole = std::floor(seen.phase);
  return {seen.end->whole + Integer(whole), seen.phase - whole};
}

FreeFlight UnfoldedLog::flight_at(const Rational& time) const {
  const Sighting seen = sight(time);
  const DecidedPhase phase = decide(seen, time);
  FreeFlight flight;
  flight.count = exact_.count_from_ray(phase.ray);
  flight.anchor = to_time(time);
  set_positions(phase.ray, phase.fraction, seen.distance, flight);
  set_velocities(*seen.end, phase.ray, flight);
  require_finite(flight);
  return flight;
}

Collision UnfoldedLog::at(const Integer& index) const {
  const Integer ray = ray_of(index);
  const double from_past = Integer(ray - past_.whole).get_d() - past_.fraction;
  const double to_future = Integer(future_.whole - ray).get_d() + future_.fraction;
  const End& end = to_future < from_past ? future_ : past_;
  const double angle = std::min(from_past, to_future) * theta_;

  // b = 0: every collision is at the corner, at the moment of closest approach.
  const bool corner = exact_.through_corner();
  const double distance = corner ? 0 : impact_ / std::sin(angle);
  const double tau = corner ? 0 : end.sign * (impact_ / speed_) / std::tan(angle);

  FreeFlight flight;
  set_positions(ray, 0, distance, flight);
  set_velocities(end, ray, flight);
  Time time = two_sum(closest_approach_.hi, tau);
  time = two_sum(time.hi, time.lo + closest_approach_.lo);
  flight.anchor = {scaled(time.hi, time_exponent_), scaled(time.lo, time_exponent_)};
  require_finite(flight);
  return {index, flight.anchor, is_odd(ray) ? CollisionKind::blocks : CollisionKind::wall,
          flight.blue, flight.red};
}

void UnfoldedLog::set_positions(const Integer& ray, double fraction, double distance,
                                FreeFlight& flight) const {
  const double angle = (is_odd(ray) ? 1 - fraction : fraction) * theta_;
  const double y2 = distance * std::cos(angle);
  const double y1 = std::min(distance * std::sin(angle) / sigma_, y2);  // never past contact
  flight.blue.position = blue_offset_ + y1;
  flight.red.position = red_offset_ + y2;
}

void UnfoldedLog::set_velocities(const End& end, const Integer& ray, FreeFlight& flight) const {
  // The direction of the line, folded back by the even number of rays next to it: reflecting
  // twice is turning by 2 theta, and an odd ray leaves one reflection of y1.
  const bool odd = is_odd(ray);
  const Integer turned = (odd ? ray + 1 : ray) - end.whole;
  const double angle = (end.fraction - turned.get_d()) * theta_;
  const double speed = end.sign * scaled(speed_, -time_exponent_);
  flight.blue.velocity = (odd ? -1 : 1) * speed * std::sin(angle) / sigma_;
  flight.red.velocity = speed * std::cos(angle);
}

}  // namespace piblocks
