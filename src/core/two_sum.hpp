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

/// a + b for |a| >= |b| or a = 0 (Dekker).
constexpr DoubleDouble ordered_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a * b, exact unless lo underflows.
inline Time two_product(double a, double b) noexcept {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

/// a * b, exact unless lo underflows or a factor is beyond 2^990 (Veltkamp, Dekker). Faster than
/// two_product() where std::fma() is a call of a function.
constexpr DoubleDouble split_product(double a, double b) noexcept {
  constexpr double kSplit = 0x1p27 + 1;
  const double a_scaled = kSplit * a;
  const double a_high = a_scaled - (a_scaled - a);
  const double a_low = a - a_high;
  const double b_scaled = kSplit * b;
  const double b_high = b_scaled - (b_scaled - b);
  const double b_low = b - b_high;
  const double product = a * b;
  const double error = ((a_high * b_high - product) + a_high * b_low) + a_low * b_high;
  return {product, error + a_low * b_low};
}

}  // namespace piblocks
