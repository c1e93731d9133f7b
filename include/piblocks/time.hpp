// An instant of simulation time to twice the precision of a double.
// In: exact rational times. Out: a sum of two doubles, hi being the nearest double to the whole.
// Near the turning point of many digits thousands of collisions share one double; this tells
// them apart.
#pragma once

#include <piblocks/exact.hpp>

#include <cmath>

namespace piblocks {

/// hi + lo, in the scene's unit of time, with |lo| <= ulp(hi)/2.
struct Time {
  double hi = 0;
  double lo = 0;

  friend bool operator==(const Time&, const Time&) = default;
};

/// a + b as hi + lo without rounding error (Knuth's two-sum; needs no order of magnitude).
constexpr Time two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

/// a * b as hi + lo without rounding error, unless lo underflows.
inline Time two_product(double a, double b) noexcept {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

/// Nearest double-double to an exact time.
Time to_time(const Rational& exact);

/// The exact value of a double-double.
/// @throws SimulationError if a part is not finite.
Rational to_rational(const Time& time);

}  // namespace piblocks
