// The number types that methods compute in, and the one that errors are measured in.
// In: results of any of them. Out: the same values without rounding.
#pragma once

#include <boost/multiprecision/float128.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <piblocks/exact.hpp>

#include <string>
#include <variant>
#include <vector>

namespace piblocks::benchmark {

namespace mp = boost::multiprecision;

using Quad = mp::number<mp::float128_backend, mp::et_off>;              ///< __float128
using Decimal50 = mp::number<mp::mpfr_float_backend<50>, mp::et_off>;   ///< MPFR, 50 digits
using Reference = mp::number<mp::mpfr_float_backend<100>, mp::et_off>;  ///< MPFR, 100 digits

template <typename Scalar>
inline const std::string kScalarName = "";
template <>
inline const std::string kScalarName<double> = "double";
template <>
inline const std::string kScalarName<long double> = "long double";
template <>
inline const std::string kScalarName<Quad> = "float128";
template <>
inline const std::string kScalarName<Decimal50> = "MPFR 50 digits";

/// Results as a method made them; converting them is not part of its work.
using Numbers = std::variant<std::vector<double>, std::vector<long double>, std::vector<Quad>,
                             std::vector<Decimal50>, std::vector<Reference>>;

inline Reference to_reference(const Rational& value) {
  Reference result;
  mpfr_set_q(result.backend().data(), value.get_mpq_t(), MPFR_RNDN);
  return result;
}

template <typename Scalar>
Scalar to_scalar(const Rational& value) {
  return static_cast<Scalar>(to_reference(value));
}

template <>
inline double to_scalar<double>(const Rational& value) {
  return to_double(value);
}

}  // namespace piblocks::benchmark
