#include "core/rounded.hpp"

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/near_functions.hpp"
#include "core/real.hpp"

namespace piblocks::rounded {
namespace {

/// A number of MPFR with a double's precision.
class Number {
 public:
  Number() { mpfr_init2(value_, std::numeric_limits<double>::digits); }
  explicit Number(double value) : Number() { mpfr_set_d(value_, value, MPFR_RNDN); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  ~Number() { mpfr_clear(value_); }
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_{};
};

/// The value of an operation of MPFR, which rounds correctly, also where a double is subnormal.
template <typename Operation, typename... Arguments>
double by_mpfr(Operation operation, Arguments... arguments) {
  free_mpfr_cache_with_thread();
  const mpfr_exp_t least = mpfr_get_emin();
  mpfr_set_emin(std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits +
                1);
  Number result;
  const int rounding = operation(result.get(), Number(arguments).get()..., MPFR_RNDN);
  mpfr_subnormalize(result.get(), rounding, MPFR_RNDN);
  mpfr_set_emin(least);
  return mpfr_get_d(result.get(), MPFR_RNDN);
}

/// The value that is near, or MPFR's.
template <typename Operation, typename... Arguments>
double round(const DoubleDouble& near, Operation operation, Arguments... arguments) {
  if (const std::optional<double> nearest = near::nearest_double(near)) return *nearest;
  return by_mpfr(operation, arguments...);
}

/// x - x^3/6 and x - x^2/2 round to x, and 1 - x^2/2 rounds to 1.
constexpr double kLinear = 0x1p-27;
constexpr double kLinearLog = 0x1p-54;

/// The power of two that takes a finite number other than 0 to 1 … 2, within 2^-1000 … 2^1000.
double scale_to_1(double x) { return std::ldexp(1, std::clamp(-std::ilogb(x), -1000, 1000)); }

}  // namespace

double sin(double x) { return std::fabs(x) < kLinear ? x : round(near::sin(x), mpfr_sin, x); }

double cos(double x) { return std::fabs(x) < kLinear ? 1 : round(near::cos(x), mpfr_cos, x); }

SinCos sin_cos(double x) {
  if (std::fabs(x) < kLinear) return {x, 1};
  const near::SinCos near = near::sin_cos(x);
  return {round(near.sin, mpfr_sin, x), round(near.cos, mpfr_cos, x)};
}

double atan2(double y, double x) {
  const DoubleDouble near = near::atan2(y, x);
  if (!std::isnan(near.lo) || !std::isfinite(x) || !std::isfinite(y) || x == 0 || y == 0) {
    return round(near, mpfr_atan2, y, x);
  }
  // Scaling is exact unless the smaller number underflows; near::atan2() refuses that number.
  const double scale = scale_to_1(std::max(std::fabs(x), std::fabs(y)));
  return round(near::atan2(y * scale, x * scale), mpfr_atan2, y, x);
}

double exp(double x) { return round(near::exp(x), mpfr_exp, x); }

double log(double x) { return round(near::log(x), mpfr_log, x); }

double log1p(double x) {
  return std::fabs(x) < kLinearLog ? x : round(near::log1p(x), mpfr_log1p, x);
}

double hypot(double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return by_mpfr(mpfr_hypot, x, y);
  const double longer = std::max(std::fabs(x), std::fabs(y));
  const double shorter = std::min(std::fabs(x), std::fabs(y));
  if (shorter <= 0x1p-28 * longer) return longer;
  const DoubleDouble near = near::hypot(longer, shorter);
  // Where a double is subnormal or overflows, MPFR knows how to round.
  const bool is_usual = longer >= 0x1p-900 && longer <= 0x1p900;
  if (!std::isnan(near.lo) || !is_usual) return round(near, mpfr_hypot, x, y);
  const double scale = scale_to_1(longer);
  return round(near::hypot(longer * scale, shorter * scale), mpfr_hypot, longer * scale,
               shorter * scale) /
         scale;
}

double log10(double x) { return by_mpfr(mpfr_log10, x); }

}  // namespace piblocks::rounded
