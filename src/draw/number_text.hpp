// Numbers as they are read in a picture, and round values along an axis.
// In: exact or rounded values of any size. Out: short UTF-8 text.
#pragma once

#include <piblocks/exact.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace piblocks {

class Font;

/// All that numbers are written with in pictures.
inline constexpr std::string_view kNumberCharacters = "0123456789,.−×⁰¹²³⁴⁵⁶⁷⁸⁹";

/// Stands for the count of a run that has had infinitely many collisions.
inline constexpr std::string_view kEndlessCount = "∞";

/// All that counts in this base are written with.
std::string count_characters(int base);

/// Width of a count that no count of as many digits exceeds: letters are not as wide as one
/// another.
double count_width_em(const Integer& count, int base, const Font& font);

/// A positive number as mantissa · 10^exponent, 1 <= mantissa < 10; zero as 0.
struct Magnitude {
  double mantissa = 0;
  long exponent = 0;
};
Magnitude magnitude_of(const Rational& value);
/// Infinity or 0 where it is beyond the range of a double.
double to_double(const Magnitude& value);
Rational power_of_ten(long exponent);

/// The square root of a number >= 0 of any size, to 16 digits.
Magnitude root_magnitude_of(const Rational& value);
/// The same with 64-bit exponents and at least 128 bits.
mpf_class root_of(const Rational& value);

/// The same number for so many decimals: a mantissa that would be rounded to 10 becomes a tenth.
Magnitude written_with(int decimals, Magnitude size);

/// With commas between thousands and a true minus sign: "−1,234.50". Zero has no sign.
std::string fixed_text(double value, int decimals);
/// The same of an exact number, every digit of it. @param decimals  >= 0
std::string fixed_text(const Rational& value, int decimals);

/// With two decimals; from 100,000 on as "−1.23×10⁹".
std::string rounded_text(double value);

/// "10⁻¹²" for -12.
std::string power_text(long exponent);

/// Exact where that is short: "10,000", "2.5", "1/3", "10¹⁶". Else of three digits: "1.23×10⁹".
std::string short_text(const Rational& value);

struct Ticks {
  double step = 1;  ///< 1, 2 or 5 times a power of ten
  std::vector<double> values;
};

/// Multiples of the smallest step >= least, from low to high, both included; at most a thousand.
Ticks ticks_of(double low, double high, double least);

/// An axis with figures at its ticks.
struct FigureAxis {
  double low;
  double high;
  double em;      ///< size of type, in units of the axis
  double gap_em;  ///< least gap between figures
};

/// The same ticks, or those of a larger step if their figures would touch.
Ticks with_room_for_figures(Ticks ticks, const FigureAxis& axis, const Font& font);

/// With the step's decimals, or its power of ten if they are many: "−0.25", "5×10⁹".
std::string tick_text(double value, double step);

/// Half of the height of figures.
inline constexpr double kHalfFigure_em = 0.365;

}  // namespace piblocks
