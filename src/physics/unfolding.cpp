#include "physics/unfolding.hpp"

#include <piblocks/error.hpp>

#include <algorithm>

namespace piblocks {
namespace {

/// Nothing is computed from less: far enough from the denormal numbers for a full relative
/// precision.
constexpr double kLeast = 0x1p-1010;

/// Exponent of a unit of time in which the line takes about 1 to pass ell, or to reach the corner,
/// so that neither the parts of a double-double near the turn nor the time to the far ends leave a
/// double's range.
long unit_exponent(const ExactMotion& exact, const Real& ell, const Real& speed) {
  constexpr long kMaxExponent = 500;  // both ways: there is as much room beyond
  const Real to_corner(ell.bits(), exact.closest_approach);
  const long exponent = !exact.through_corner() ? ell.exponent() - speed.exponent()
                        : to_corner.sign() != 0 ? to_corner.exponent()
                                                : -speed.exponent();
  return std::clamp(exponent, -kMaxExponent, kMaxExponent);
}

}  // namespace

Unfolding::Unfolding(const TwoBlocks& system, const ExactMotion& exact)
    : turn(exact.turn()), start(exact.start()) {
  const Wedge wedge = exact.wedge(kLandmark_bits);
  first_index = exact.first_index(wedge.past);
  size = exact.total(wedge.future);
  past = {wedge.past, -1};
  future = {wedge.future, +1};
  const mpfr_prec_t bits = wedge.sigma.bits();
  const Real exact_speed = sqrt(Real(bits, exact.speed_squared));
  const Real exact_ell = Real(bits, abs(exact.areal_velocity)) / exact_speed;
  const long exponent = unit_exponent(exact, exact_ell, exact_speed);
  const Real scaled_speed = scaled(exact_speed, exponent);

  sigma = wedge.sigma.to_double();
  theta = wedge.theta.to_double_double();
  const DoubleDouble rays = future.steps_from(past.ray);
  total_phase = rays.hi + (rays.lo + past.beyond.hi + future.beyond.hi);
  step = direction({1, 0}, {});
  ell = exact_ell.to_double();
  corner_distance = (wedge.sigma * exact_ell).to_double();
  speed = scaled_speed.to_double();
  passage = (wedge.sigma * exact_ell / scaled_speed).to_double();
  speed_over_ell = exact.through_corner() ? 0 : (scaled_speed / exact_ell).to_double();
  // In the chosen unit of time the speed is a typical length.
  const double least = exact.through_corner() ? speed : std::min({ell, speed, passage});
  if (least < kLeast) {
    throw SimulationError(
        "closed form: lengths or times are so short that doubles cannot tell where the "
        "blocks turn; use greater units");
  }
  time_unit = std::scalbln(1.0, exponent);
  closest_approach = to_time(exact.closest_approach / Rational(time_unit));
  const Real range = sqrt(Real(bits, exact.ratio * exact.y1 * exact.y1 + exact.y2 * exact.y2));
  start_range = (range / scaled_speed).to_double();
  if (!exact.through_corner() && exact.closest_approach != 0 && std::isfinite(start_range)) {
    near_start = exact.closest_approach > 0 ? NearStart::until : NearStart::after;
    half_way = exact.phase_at(exact.closest_approach / 2).ray;
  }
  red_speed = exact_speed.to_double();
  blue_speed = (exact_speed / wedge.sigma).to_double();
  blue_offset = to_double(system.wall_face + system.blue.width / 2);
  red_offset = to_double(system.wall_face + system.blue.width + system.red.width / 2);
}

double Unfolding::distance_at(double tau) const {
  // The quotient loses precision where it is near the denormal numbers.
  const double way = speed_over_ell < kLeast ? tau * speed / ell : tau * speed_over_ell;
  return std::min(std::fabs(way), kFarAway);
}

}  // namespace piblocks
