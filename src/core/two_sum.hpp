// Arithmetic without rounding errors.
// In: two doubles. Out: their sum or product as two doubles.
#pragma once

#include <piblocks/exact.hpp>

#include <cmath>

namespace piblocks {

/// a + b (Knuth's two-sum; needs no order of magnitude).
constexpr Time two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

/// a * b, exact unless lo underflows.
inline Time two_product(double a, double b) noexcept {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

}  // namespace piblocks
