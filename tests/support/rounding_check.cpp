#include "support/rounding_check.hpp"

#include <mpfr.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/near_functions.hpp"
#include "core/rounded.hpp"

namespace piblocks {
namespace {

/// A number of MPFR, made once for each thread.
template <int bits>
mpfr_ptr scratch(std::size_t place) {
  struct Numbers {
    Numbers() {
      for (mpfr_t& number : of) mpfr_init2(number, bits);
    }
    ~Numbers() {
      for (mpfr_t& number : of) mpfr_clear(number);
    }
    std::array<mpfr_t, 4> of;
  };
  static thread_local Numbers numbers;
  return numbers.of.at(place);
}

template <int bits, typename Operation>
int apply(const Operation& operation, double x, double y) {
  mpfr_set_d(scratch<53>(0), x, MPFR_RNDN);
  mpfr_set_d(scratch<53>(1), y, MPFR_RNDN);
  if constexpr (requires {
                  operation(scratch<bits>(2), scratch<53>(0), scratch<53>(1), MPFR_RNDN);
                }) {
    return operation(scratch<bits>(2), scratch<53>(0), scratch<53>(1), MPFR_RNDN);
  } else {
    return operation(scratch<bits>(2), scratch<53>(0), MPFR_RNDN);
  }
}

/// Every double in MPFR's terms: 2^-1074 is 1/2 times 2^-1073.
template <auto operation>
double by_mpfr(double x, double y) {
  mpfr_set_emin(-1073);
  const int rounding = apply<53>(operation, x, y);
  mpfr_subnormalize(scratch<53>(2), rounding, MPFR_RNDN);
  mpfr_set_emin(mpfr_get_emin_min());
  return mpfr_get_d(scratch<53>(2), MPFR_RNDN);
}

template <auto operation>
double error(const DoubleDouble& near, double x, double y) {
  apply<200>(operation, x, y);
  mpfr_ptr const value = scratch<200>(2);
  mpfr_ptr const difference = scratch<200>(3);
  mpfr_sub_d(difference, value, near.hi, MPFR_RNDN);
  mpfr_sub_d(difference, difference, near.lo, MPFR_RNDN);
  if (mpfr_zero_p(difference) != 0) return 0;
  mpfr_div(difference, difference, value, MPFR_RNDN);
  return std::fabs(mpfr_get_d(difference, MPFR_RNDN));
}

double sign(Random& random) { return random.integer(0, 1) == 0 ? -1 : 1; }

/// Every significand is equally likely, and every exponent.
double of_exponents(Random& random, int low, int high) {
  return std::ldexp(random.uniform(1, 2), static_cast<int>(random.integer(low, high)));
}

double any(Random& random) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(random.integer(
                                   0, std::numeric_limits<std::int64_t>::max() >> 10))
                                   << 10 ^
                               static_cast<std::uint64_t>(random.integer(0, 1023))) *
         sign(random);
}

/// x, or up to three ulps from it.
double beside(Random& random, double x) {
  const double to = sign(random) * std::numeric_limits<double>::infinity();
  for (std::int64_t steps = random.integer(0, 3); steps > 0; --steps) x = std::nextafter(x, to);
  return x;
}

Arguments angle(Random& random) {
  switch (random.integer(0, 15)) {
    case 0:
      return {any(random), 0};
    case 1:
      return {beside(random, double(random.integer(0, 700)) * (std::numbers::pi / 2)), 0};
    case 2:
      return {beside(random, double(random.integer(0, 300000)) * (std::numbers::pi / 2048)), 0};
    case 3:
    case 4:
    case 5:
      return {sign(random) * of_exponents(random, -30, 11), 0};
    case 6:
    case 7:
      return {random.uniform(-1030, 1030), 0};
    default:
      return {random.uniform(-7, 7), 0};
  }
}

Arguments power(Random& random) {
  switch (random.integer(0, 7)) {
    case 0:
      return {any(random), 0};
    case 1:
      return {beside(random, double(random.integer(-200000, 200000)) * (std::numbers::ln2 / 512)),
              0};
    case 2:
      return {random.uniform(-750, 720), 0};
    case 3:
    case 4:
      return {sign(random) * of_exponents(random, -60, 9), 0};
    default:
      return {random.uniform(-10, 10), 0};
  }
}

Arguments positive(Random& random) {
  switch (random.integer(0, 7)) {
    case 0:
      return {std::fabs(any(random)), 0};
    case 1:
      return {1 + sign(random) * of_exponents(random, -53, -1), 0};
    case 2:
      return {beside(random, double(random.integer(1, 4096)) / 512), 0};
    case 3:
    case 4:
      return {random.uniform(0.5, 2), 0};
    default:
      return {of_exponents(random, -60, 60), 0};
  }
}

Arguments more_than_minus_1(Random& random) {
  switch (random.integer(0, 7)) {
    case 0:
      return {std::fabs(any(random)), 0};
    case 1:
      return {std::fma(-1, of_exponents(random, -60, -2), random.integer(-1, 0)), 0};
    case 2:
      return {beside(random, double(random.integer(-511, 4096)) / 512), 0};
    case 3:
    case 4:
      return {random.uniform(-1, 1), 0};
    default:
      return {sign(random) * of_exponents(random, -60, -1), 0};
  }
}

Arguments point(Random& random) {
  const double x =
      random.integer(0, 7) == 0 ? any(random) : sign(random) * of_exponents(random, -8, 8);
  switch (random.integer(0, 7)) {
    case 0:
      return {any(random), x};
    case 1:
      return {beside(random, x * double(random.integer(0, 512)) / 512), x};
    case 2:
      return {x * sign(random) * of_exponents(random, -60, 60), x};
    case 3:
      return {sign(random) * double(random.integer(0, 100)), double(random.integer(0, 100))};
    default:
      return {sign(random) * of_exponents(random, -8, 8), x};
  }
}

using Unary = double (*)(double);
using Binary = double (*)(double, double);
using NearBinary = DoubleDouble (*)(double, double);
using Draw = Arguments (*)(Random&);

/// Of the first argument alone.
template <auto function>
auto first_of(double x, double /*y*/) {
  return function(x);
}

template <Unary rounded, auto mpfr, Unary c_library>
constexpr RoundedFunction unary(const char* name, NearBinary near, Draw draw) {
  return {name, first_of<rounded>, by_mpfr<mpfr>, near, error<mpfr>, first_of<c_library>, draw};
}

template <Binary rounded, auto mpfr, Binary c_library>
constexpr RoundedFunction binary(const char* name, NearBinary near, Draw draw) {
  return {name, rounded, by_mpfr<mpfr>, near, error<mpfr>, c_library, draw};
}

double rounded_sine_of_both(double x) { return rounded::sin_cos(x).sin; }
double rounded_cosine_of_both(double x) { return rounded::sin_cos(x).cos; }

}  // namespace

const std::array<RoundedFunction, 10> kRoundedFunctions{
    unary<rounded::sin, mpfr_sin, ::sin>("sin", first_of<near::sin>, angle),
    unary<rounded::cos, mpfr_cos, ::cos>("cos", first_of<near::cos>, angle),
    unary<rounded_sine_of_both, mpfr_sin, ::sin>("sin_cos.sin", first_of<near::sin>, angle),
    unary<rounded_cosine_of_both, mpfr_cos, ::cos>("sin_cos.cos", first_of<near::cos>, angle),
    binary<rounded::atan2, mpfr_atan2, ::atan2>("atan2", near::atan2, point),
    unary<rounded::exp, mpfr_exp, ::exp>("exp", first_of<near::exp>, power),
    unary<rounded::log, mpfr_log, ::log>("log", first_of<near::log>, positive),
    unary<rounded::log1p, mpfr_log1p, ::log1p>("log1p", first_of<near::log1p>, more_than_minus_1),
    binary<rounded::hypot, mpfr_hypot, ::hypot>("hypot", near::hypot, point),
    unary<rounded::log10, mpfr_log10, ::log10>("log10", nullptr, positive),
};

bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

RoundingTally check_rounding(const RoundedFunction& function, std::int64_t arguments, Random random,
                             std::int64_t error_every) {
  RoundingTally tally;
  for (std::int64_t i = 0; i < arguments; ++i) {
    const auto [x, y] = function.random_arguments(random);
    const double value = function.rounded(x, y);
    if (!is_same(value, function.by_mpfr(x, y))) {
      ++tally.wrong;
      tally.wrong_at = {x, y};
    }
    if (!is_same(value, function.from_c_library(x, y))) ++tally.unlike_c;
    const DoubleDouble near =
        function.near != nullptr ? function.near(x, y) : DoubleDouble{0, std::nan("")};
    if (std::isnan(near.lo)) {
      ++tally.outside;
      continue;
    }
    if (!near::nearest_double(near)) ++tally.undecided;
    if (i % error_every != 0) continue;
    const double error = function.error(near, x, y);
    if (error > tally.largest_error) {
      tally.largest_error = error;
      tally.largest_error_at = {x, y};
    }
  }
  return tally;
}

}  // namespace piblocks
