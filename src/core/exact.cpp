#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/real.hpp"
#include "core/text.hpp"
#include "core/whole_number.hpp"

namespace piblocks {
namespace {

constexpr const char* kNotANumber = "not a number such as 16, 2.5, 1/3 or 1e6";

constexpr double kBitsPerDigit = 3.3219280948873626;  // log2(10)

[[noreturn]] void fail_too_long(std::int64_t max_bits) {
  throw UsageError(fmt::format("is longer than {} bits, which are {:.0f} decimal digits", max_bits,
                               std::floor(double(max_bits) / kBitsPerDigit)));
}

/// The bits of the numerator or the denominator, whichever is longer.
std::size_t bits_of(const Rational& value) {
  return std::max(mpz_sizeinbase(value.get_num_mpz_t(), 2),
                  mpz_sizeinbase(value.get_den_mpz_t(), 2));
}

void check_length(const Rational& value, std::int64_t max_bits) {
  if (bits_of(value) > std::size_t(max_bits)) fail_too_long(max_bits);
}

Rational power_within(std::int64_t max_bits, const Rational& base, unsigned long exponent) {
  // A lower bound of the power's bits. The power has at most twice as many, unless the base is 0
  // or 1, so that what passes is cheap to compute.
  if (double(bits_of(base) - 1) * double(exponent) >= double(max_bits)) fail_too_long(max_bits);
  Rational result;
  mpz_pow_ui(result.get_num_mpz_t(), base.get_num_mpz_t(), exponent);
  mpz_pow_ui(result.get_den_mpz_t(), base.get_den_mpz_t(), exponent);
  check_length(result, max_bits);
  return result;  // powers of coprime numbers are coprime: still in lowest terms
}

/// Reads `text` from the left; every step consumes what it understood.
class NumberReader {
 public:
  NumberReader(std::string_view text, std::int64_t max_bits) : rest_(text), max_bits_(max_bits) {}

  Rational quotient() {
    Rational value = factor();
    if (take('/')) {
      const Rational divisor = factor();
      if (divisor == 0) throw UsageError("division by zero");
      value /= divisor;
    }
    if (!rest_.empty()) throw UsageError(kNotANumber);
    check_length(value, max_bits_);
    return value;
  }

 private:
  bool take(char wanted) {
    if (rest_.empty() || rest_.front() != wanted) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool take_sign() {
    if (take('-')) return true;
    take('+');
    return false;
  }

  std::string_view digits() {
    std::size_t length = 0;
    while (length < rest_.size() && rest_[length] >= '0' && rest_[length] <= '9') ++length;
    const std::string_view found = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return found;
  }

  long exponent() {
    const bool negative = take_sign();
    const std::string_view text = digits();
    if (text.empty()) throw UsageError(kNotANumber);
    long value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc{} || value > max_bits_) fail_too_long(max_bits_);
    return negative ? -value : value;
  }

  /// A power binds more closely than a sign: -2^2 is -4.
  Rational factor() {
    const bool negative = take_sign();
    const Rational value = power_of_decimal();
    return negative ? Rational(-value) : value;
  }

  Rational power_of_decimal() {
    Rational base = decimal();
    if (!take('^')) return base;
    const long n = exponent();
    if (base == 0 && n < 0) throw UsageError("division by zero");
    const Rational raised = power_within(max_bits_, base, static_cast<unsigned long>(std::labs(n)));
    return n < 0 ? Rational(1 / raised) : raised;
  }

  Rational decimal() {
    std::string mantissa(digits());
    long scale = 0;
    if (take('.')) {
      const std::string_view fraction = digits();
      mantissa += fraction;
      scale = -static_cast<long>(fraction.size());
    }
    if (mantissa.empty()) throw UsageError(kNotANumber);
    if (take('e') || take('E')) scale += exponent();
    const auto digits = static_cast<double>(mantissa.size());
    // The longer one of numerator and denominator has so many digits.
    const double length = scale > 0 ? digits + double(scale) : std::max(digits, -double(scale));
    if (length * kBitsPerDigit > double(max_bits_)) fail_too_long(max_bits_);

    Rational value{Integer(mantissa, 10)};
    const Rational ten_power =
        power_within(max_bits_, 10, static_cast<unsigned long>(std::labs(scale)));
    if (scale < 0) value /= ten_power;
    if (scale > 0) value *= ten_power;
    return value;
  }

  std::string_view rest_;
  std::int64_t max_bits_;
};

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

Rational parse_rational(std::string_view text, std::int64_t max_bits) {
  return NumberReader(trimmed(text), max_bits).quotient();
}

std::optional<Integer> whole_number(std::string_view text) {
  try {
    const Rational value = parse_rational(text);
    if (value.get_den() == 1) return value.get_num();
  } catch (const UsageError&) {  // the caller says better what is wanted
  }
  return std::nullopt;
}

Integer parse_whole_number(std::string_view text, const Integer& low,
                           const std::optional<Integer>& high) {
  const std::optional<Integer> value = whole_number(text);
  if (value && *value >= low && (!high || *value <= *high)) return *value;
  const std::string upper = high ? "to " + high->get_str() : "on";
  throw UsageError(fmt::format("must be a whole number from {} {}", low.get_str(), upper));
}

int parse_int(std::string_view text, int low, int high) {
  return static_cast<int>(parse_whole_number(text, low, Integer(high)).get_si());
}

Rational rational_from_decimal(double value) {
  if (!std::isfinite(value)) throw UsageError("not a finite number");
  return parse_rational(fmt::format("{}", value));
}

std::optional<double> exact_double(const Integer& value) {
  constexpr std::size_t kPrecision_bits = 53;
  constexpr std::size_t kMaxSize_bits = 1000;
  if (mpz_size(value.get_mpz_t()) <= 1) {  // nearly all: a shortcut
    const mp_limb_t limb = mpz_getlimbn(value.get_mpz_t(), 0);
    if (limb >> kPrecision_bits == 0) return value < 0 ? -double(limb) : double(limb);
  }
  const std::size_t size = mpz_sizeinbase(value.get_mpz_t(), 2);
  const bool fits =
      size <= kPrecision_bits ||
      (size <= kMaxSize_bits && size - mpz_scan1(value.get_mpz_t(), 0) <= kPrecision_bits);
  if (!fits) return std::nullopt;
  return value.get_d();
}

double to_double(const Rational& value) {
  const auto numerator = exact_double(value.get_num());
  const auto denominator = exact_double(value.get_den());
  if (numerator && denominator) return *numerator / *denominator;
  // 192 bits before the last rounding: the result is the nearest double unless the value lies
  // within 2^-138 of its relative size from the middle of two doubles.
  return Real(192, value).to_double();
}

Integer floor(const Rational& value) {
  Integer result;
  mpz_fdiv_q(result.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
  return result;
}

Integer ceil(const Rational& value) { return -floor(-value); }

Rational power(const Rational& base, unsigned long exponent) {
  return power_within(kMaxMassBits, base, exponent);
}

std::string with_thousands_separators(const Integer& value) {
  std::string text = value.get_str();
  const std::size_t first = text.front() == '-' ? 1 : 0;
  for (std::size_t end = text.size(); end > first + 3; end -= 3) text.insert(end - 3, 1, ',');
  return text;
}

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

std::string readable(const Integer& value) {
  constexpr std::size_t kMaxDigitsShown = 30;
  const std::string digits = Integer(abs(value)).get_str();
  if (digits.size() <= kMaxDigitsShown) return with_thousands_separators(value);
  return fmt::format("about {}10^{}", value < 0 ? "-" : "", digits.size() - 1);
}

std::string to_text(const Rational& value) {
  const std::string exact = value.get_str();
  return exact.size() <= 24 ? exact : fmt::format("{}", to_double(value));
}

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
