// Exact numbers: what a user writes is what is computed with.
// In: text such as "100^7", "1/3", "-2.5e-3". Out: GMP integers and rationals, never rounded.
#pragma once

#include <gmpxx.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace piblocks {

using Integer = mpz_class;   ///< a count or an index of collisions
using Rational = mpq_class;  ///< a mass, length, velocity or time, in lowest terms

/// Longest numerator or denominator that a user may give, in bits: 4932 decimal digits. The limit
/// keeps sums and products of times, lengths and velocities fast.
inline constexpr std::int64_t kMaxRationalBits = 16'384;
/// The same for a block's mass. Masses may be longer, because counts go further than positions:
/// 36^199998, the mass ratio of 100,000 digits in base 36, has 1,033,975 bits.
inline constexpr std::int64_t kMaxMassBits = 1'050'000;

/// GMP takes a long, which is another type than std::int64_t on some systems.
inline Integer to_integer(std::int64_t value) {
  static_assert(sizeof(long) == sizeof value);
  return {static_cast<long>(value)};
}

/// Reads VALUE, VALUE/VALUE or VALUE^EXPONENT where VALUE is a decimal number with optional sign,
/// fraction and power of ten, and EXPONENT an integer; the two forms combine: "100^7/3". A power
/// binds more closely than a sign: "-2^2" is -4.
/// @throws UsageError saying what is wrong with the text, or that it is longer than the limit.
Rational parse_rational(std::string_view text, std::int64_t max_bits = kMaxRationalBits);

/// The shortest decimal that reads back as `value`, so that 0.1 is 1/10.
/// @throws UsageError if value is not finite.
Rational rational_from_decimal(double value);

/// The integer as a double where that needs no rounding and is far from the end of its range.
std::optional<double> exact_double(const Integer& value);

/// Nearest double; overflows to infinity, underflows to zero.
double to_double(const Rational& value);

Integer ceil(const Rational& value);
Integer floor(const Rational& value);

/// base^exponent for exponent >= 0. @throws UsageError if that is longer than kMaxMassBits.
Rational power(const Rational& base, unsigned long exponent);

/// The integer with a comma between groups of three digits: 3,141,592.
std::string with_thousands_separators(const Integer& value);

// Bases in which a count can be written.
inline constexpr int kMinBase = 2;
inline constexpr int kMaxBase = 36;
inline constexpr int kUsualBase = 10;

/// The integer as a picture shows it: 3,141 in base 10, 110001000101 in base 2. Digits above 9 are
/// small letters. Only base 10 has separators: groups are counted from the right, so in other bases
/// they would not be those of pi's digits, which are counted from the point.
/// @param base  kMinBase … kMaxBase
std::string count_text(const Integer& value, int base);

/// The first digits of pi in this base, truncated: pi_digits(10, 5) is "3.1415". In base 2 pi
/// begins with "11.", in base 3 with "10.". There is no point unless a digit follows it.
/// @param base  kMinBase … kMaxBase
std::string pi_digits(int base, std::size_t count);

/// The integer for a message: with separators, or as a power of ten if that would fill the line.
std::string readable(const Integer& value);
/// The number for a message: exact where that is short, otherwise the nearest double.
std::string to_text(const Rational& value);

/// A number as the sum hi + lo of two doubles with |lo| <= ulp(hi)/2. Simulation time is one: near
/// the turn of many digits thousands of collisions share one double; two doubles tell them apart.
struct DoubleDouble {
  double hi = 0;
  double lo = 0;

  friend bool operator==(const DoubleDouble&, const DoubleDouble&) = default;
};
using Time = DoubleDouble;

/// Nearest sum of two doubles to an exact time.
Time to_time(const Rational& exact);

/// Exactly hi + lo. @throws SimulationError if hi or lo is not finite.
Rational to_rational(const Time& time);

}  // namespace piblocks
