#include "draw/panels/digit_margin.hpp"

#include <algorithm>
#include <cassert>

#include "core/real.hpp"

namespace piblocks {
namespace {

constexpr mpfr_prec_t kSpare_bits = 128;

mpfr_prec_t bits_of(const Integer& value) {
  return static_cast<mpfr_prec_t>(mpz_sizeinbase(value.get_mpz_t(), 2));
}

/// arctan(1 / scale)
Real theta_of(const Rational& scale, mpfr_prec_t bits) { return atan(Real(bits, 1 / scale)); }

/// floor(value · scale) of an irrational number, which `value` has to any precision.
/// @param size_bits  of the result, at least
template <typename Value>
Integer floor_of(const Value& value, const Rational& scale, mpfr_prec_t size_bits) {
  constexpr mpfr_prec_t kMore_bits = 64;
  constexpr long kRoundings_bits = 8;
  for (mpfr_prec_t bits = size_bits + kMore_bits;; bits += kMore_bits) {
    const Real nearest = value(bits) * Real(bits, scale);
    const Real error = scaled(nearest, kRoundings_bits - bits);
    Integer below = (nearest - error).floor();
    if (below == (nearest + error).floor()) return below;
  }
}

Rational power_of(int base, std::size_t exponent) {
  return power(base, static_cast<unsigned long>(exponent));
}

/// Of the number value / base^digits.
std::string text_of(const Integer& value, int base, std::size_t digits) {
  const Integer scale = power_of(base, digits).get_num();
  const Integer whole = value / scale;
  std::string text = count_text(whole, base);
  if (digits == 0) return text;
  const std::string rest = Integer(value % scale).get_str(base);
  return text + '.' + std::string(digits - rest.size(), '0') + rest;
}

std::string behind_point(const std::string& text) { return text.substr(text.find('.') + 1); }

}  // namespace

DigitMargin::DigitMargin(int base, unsigned long places)
    : base_(base), places_(places), scale_(power(base, places)) {
  assert(base >= kMinBase && base <= kMaxBase);
  // pi/s and pi/theta have the first two thirds of these bits in common.
  const mpfr_prec_t bits = 3 * bits_of(scale_.get_num()) + 2 * kSpare_bits;
  const Real scaled_pi = Real::pi(bits) * Real(bits, scale_);
  const Real rays = Real::pi(bits) / theta_of(scale_, bits);
  whole_ = floor_of(Real::pi, scale_, bits_of(scale_.get_num()) + 2);
  fraction_ = (scaled_pi - whole_).to_rational();
  excess_ = (rays - scaled_pi).to_rational();
  if (places == 0) excess_ = 1 - fraction_;  // pi/theta is 4
}

std::string DigitMargin::scaled_pi(std::size_t digits) const {
  const Rational scale = scale_ * power_of(base_, digits);
  return text_of(floor_of(Real::pi, scale, bits_of(scale.get_num()) + 2), base_, digits);
}

std::string DigitMargin::pi_over_theta(std::size_t digits) const {
  if (places_ == 0) return count_text(whole_ + 1, base_);
  // By Niven's theorem arctan s is no rational part of pi for a rational s below 1.
  const auto rays = [&](mpfr_prec_t bits) { return Real::pi(bits) / theta_of(scale_, bits); };
  const Rational scale = power_of(base_, digits);
  const mpfr_prec_t size = bits_of(scale.get_num()) + bits_of(scale_.get_num()) + 2;
  return text_of(floor_of(rays, scale, size), base_, digits);
}

std::string DigitMargin::following(std::size_t digits) const {
  return behind_point(scaled_pi(digits));
}

std::string DigitMargin::needed(std::size_t digits) const {
  // One more ray is crossed if (whole + 1) theta < pi.
  const Rational rays = whole_ + 1;
  const auto least_pi = [&](mpfr_prec_t bits) { return Real(bits, rays) * theta_of(scale_, bits); };
  const Rational scale = scale_ * power_of(base_, digits);
  return behind_point(
      text_of(floor_of(least_pi, scale, bits_of(scale.get_num()) + 2), base_, digits));
}

std::size_t DigitMargin::nines() const {
  const char nine = Integer(base_ - 1).get_str(base_).front();
  // What is needed is less than 2 s below the next whole number.
  const std::string digits = needed(places_ + 2);
  return static_cast<std::size_t>(std::ranges::find_if(digits, [&](char c) { return c != nine; }) -
                                  digits.begin());
}

}  // namespace piblocks
