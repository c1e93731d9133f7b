// Floating point of any precision, and the size of exact numbers.
// In: exact rationals and a number of bits. Out: correctly rounded results of MPFR.
#pragma once

#include <mpfr.h>
#include <piblocks/exact.hpp>

#include <algorithm>
#include <cstddef>

namespace piblocks {

/// Bits of the numerator and the denominator together.
inline std::size_t size_bits(const Rational& value) {
  return mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2);
}

/// Frees at the end of a thread what MPFR keeps for it, constants and spare numbers, and never
/// frees by itself (MPFR 4.2 manual, "Memory handling"). Cheap to call again.
inline void free_mpfr_cache_with_thread() {
  struct Cache {
    Cache() = default;
    ~Cache() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
    Cache(const Cache&) = delete;
    Cache& operator=(const Cache&) = delete;
  };
  static thread_local const Cache cache;
  static_cast<void>(cache);
}

/// A number of `bits` bits of precision. A result has the precision of its longer operand.
class Real {
 public:
  explicit Real(mpfr_prec_t bits) {
    free_mpfr_cache_with_thread();
    mpfr_init2(value_, bits);
  }
  Real(mpfr_prec_t bits, const Rational& exact) : Real(bits) {
    mpfr_set_q(value_, exact.get_mpq_t(), MPFR_RNDN);
  }
  Real(const Real& other) : Real(other.bits()) { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Real& operator=(Real other) noexcept {
    mpfr_swap(value_, other.value_);
    return *this;
  }
  ~Real() { mpfr_clear(value_); }

  static Real pi(mpfr_prec_t bits) {
    Real result(bits);
    mpfr_const_pi(result.value_, MPFR_RNDN);
    return result;
  }

  mpfr_prec_t bits() const noexcept { return mpfr_get_prec(value_); }
  int sign() const noexcept { return mpfr_sgn(value_); }
  /// Nearest double; overflows to infinity.
  double to_double() const { return mpfr_get_d(value_, MPFR_RNDN); }
  /// Nearest sum of two doubles.
  DoubleDouble to_double_double() const {
    Real rest(bits());
    mpfr_sub_d(rest.value_, value_, to_double(), MPFR_RNDN);
    return {to_double(), rest.to_double()};
  }
  /// The exponent e of |value| = m * 2^e with 1/2 <= m < 1; 0 for zero.
  long exponent() const { return mpfr_zero_p(value_) != 0 ? 0 : mpfr_get_exp(value_); }
  /// The exact value.
  Rational to_rational() const {
    Rational result;
    mpfr_get_q(result.get_mpq_t(), value_);
    return result;
  }
  /// Largest integer <= value.
  Integer floor() const {
    Integer result;
    mpfr_get_z(result.get_mpz_t(), value_, MPFR_RNDD);
    return result;
  }

  friend Real operator+(const Real& a, const Real& b) { return binary(mpfr_add, a, b); }
  friend Real operator-(const Real& a, const Real& b) { return binary(mpfr_sub, a, b); }
  friend Real operator*(const Real& a, const Real& b) { return binary(mpfr_mul, a, b); }
  friend Real operator/(const Real& a, const Real& b) { return binary(mpfr_div, a, b); }
  friend Real atan2(const Real& y, const Real& x) { return binary(mpfr_atan2, y, x); }
  friend Real operator-(const Real& a, const Integer& b) {
    Real result(a.bits());
    mpfr_sub_z(result.value_, a.value_, b.get_mpz_t(), MPFR_RNDN);
    return result;
  }
  friend Real sqrt(const Real& a) { return unary(mpfr_sqrt, a); }
  friend Real atan(const Real& a) { return unary(mpfr_atan, a); }
  friend Real cot(const Real& a) { return unary(mpfr_cot, a); }
  friend Real sin(const Real& a) { return unary(mpfr_sin, a); }
  friend Real cos(const Real& a) { return unary(mpfr_cos, a); }
  friend Real exp(const Real& a) { return unary(mpfr_exp, a); }
  friend Real expm1(const Real& a) { return unary(mpfr_expm1, a); }
  friend Real log(const Real& a) { return unary(mpfr_log, a); }
  friend Real log1p(const Real& a) { return unary(mpfr_log1p, a); }
  friend Real operator-(const Real& a) { return unary(mpfr_neg, a); }
  /// a * 2^exponent, exactly.
  friend Real scaled(const Real& a, long exponent) {
    Real result(a.bits());
    mpfr_mul_2si(result.value_, a.value_, exponent, MPFR_RNDN);
    return result;
  }

 private:
  template <typename Operation>
  static Real unary(Operation operation, const Real& a) {
    Real result(a.bits());
    operation(result.value_, a.value_, MPFR_RNDN);
    return result;
  }
  template <typename Operation>
  static Real binary(Operation operation, const Real& a, const Real& b) {
    Real result(std::max(a.bits(), b.bits()));
    operation(result.value_, a.value_, b.value_, MPFR_RNDN);
    return result;
  }

  mpfr_t value_{};
};

}  // namespace piblocks
