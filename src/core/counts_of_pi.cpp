#include <piblocks/exact.hpp>

#include <cassert>

#include "core/real.hpp"

namespace piblocks {
namespace {

/// floor(pi * base^places)
Integer floor_of_pi(int base, unsigned long places) {
  const Integer scale = power(base, places).get_num();
  // Few guard bits do in most cases. The loop ends: pi is irrational.
  constexpr mpfr_prec_t kGuard_bits = 8;
  constexpr mpfr_prec_t kMore_bits = 64;
  auto bits = static_cast<mpfr_prec_t>(mpz_sizeinbase(scale.get_mpz_t(), 2)) + kGuard_bits;
  for (;; bits += kMore_bits) {
    const Rational nearest = Real::pi(bits).to_rational();
    // pi is between 2 and 4, so the last of its bits is worth 2^(2 - bits).
    const Rational error = scaled(Real(bits, 1), 1 - bits).to_rational();
    Integer below = floor((nearest - error) * scale);
    if (below == floor((nearest + error) * scale)) return below;
  }
}

}  // namespace

std::string count_text(const Integer& value, int base) {
  assert(base >= kMinBase && base <= kMaxBase);
  return base == kUsualBase ? with_thousands_separators(value) : value.get_str(base);
}

std::string pi_digits(int base, std::size_t count) {
  assert(base >= kMinBase && base <= kMaxBase);
  const std::size_t whole = floor_of_pi(base, 0).get_str(base).size();
  if (count <= whole) return floor_of_pi(base, 0).get_str(base).substr(0, count);
  return floor_of_pi(base, count - whole).get_str(base).insert(whole, ".");
}

}  // namespace piblocks
