#include <piblocks/error.hpp>
#include <piblocks/time.hpp>

#include <cmath>

namespace piblocks {

Time to_time(const Rational& exact) {
  const auto numerator = exact_double(exact.get_num());
  const auto denominator = exact_double(exact.get_den());
  if (numerator && denominator) {
    const double quotient = *numerator / *denominator;
    const double remainder = std::fma(-quotient, *denominator, *numerator);  // exact
    return {quotient, remainder / *denominator};
  }
  const double hi = to_double(exact);
  if (!std::isfinite(hi)) return {hi, 0};
  return {hi, to_double(exact - Rational(hi))};
}

Rational to_rational(const Time& time) {
  if (!std::isfinite(time.hi) || !std::isfinite(time.lo)) {
    throw SimulationError("time: not representable as a double");
  }
  return Rational(time.hi) + Rational(time.lo);
}

}  // namespace piblocks
