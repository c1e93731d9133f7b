#include "draw/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rounded.hpp"
#include "draw/font.hpp"

namespace piblocks {
namespace {

constexpr std::string_view kMinus = "−";

std::string with_commas(std::string digits) {
  const std::size_t point = std::min(digits.find('.'), digits.size());
  for (std::size_t i = point; i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

/// Of the mantissa. GMP's exponents have room for any number that the program takes.
constexpr mp_bitcnt_t kBits = 128;

Magnitude split(const mpf_class& value) {
  if (value <= 0) return {};
  mp_exp_t exponent = 0;
  std::string digits = value.get_str(exponent, 10, 17);
  digits.insert(1, ".");
  return {std::stod(digits), static_cast<long>(exponent) - 1};
}

}  // namespace

std::string count_characters(int base) {
  std::string characters = ",-";
  for (int digit = 0; digit < base; ++digit) characters += Integer(digit).get_str(base);
  return characters;
}

double count_width_em(const Integer& count, int base, const Font& font) {
  std::string text = count_text(count, base);
  if (base <= kUsualBase) return font.width_em(text);  // figures are tabular
  const std::string characters = count_characters(base);
  const auto width = [&](char c) { return font.width_em({&c, 1}); };
  const char widest = *std::ranges::max_element(characters, {}, width);
  std::ranges::replace_if(
      text, [](char c) { return c != '-'; }, widest);
  return font.width_em(text);
}

Magnitude magnitude_of(const Rational& value) { return split(mpf_class(value, kBits)); }

double to_double(const Magnitude& value) {
  constexpr long kMostExponent = 1000;
  const long exponent = std::clamp(value.exponent, -kMostExponent, kMostExponent);
  return to_double(Rational(value.mantissa) * power_of_ten(exponent));
}

Rational power_of_ten(long exponent) {
  const Rational power = piblocks::power(10, static_cast<unsigned long>(std::abs(exponent)));
  return exponent < 0 ? Rational(1 / power) : power;
}

Magnitude root_magnitude_of(const Rational& value) { return split(root_of(value)); }

mpf_class root_of(const Rational& value) { return sqrt(mpf_class(value, kBits)); }

Magnitude written_with(int decimals, Magnitude size) {
  if (size.mantissa < 10 - 0.5 * to_double(power_of_ten(-decimals))) return size;
  return {size.mantissa / 10, size.exponent + 1};
}

std::string fixed_text(double value, int decimals) {
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = digits.find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !is_zero ? std::string(kMinus) : "") + with_commas(digits);
}

std::string fixed_text(const Rational& value, int decimals) {
  const Rational scaled = abs(value) * power_of_ten(decimals);
  const Integer below = floor(scaled);
  const Rational rest = scaled - below;
  // A tie goes to the even digit, as when doubles are printed.
  const bool is_up = rest > Rational(1, 2) || (rest == Rational(1, 2) && below % 2 != 0);
  const Integer rounded = below + (is_up ? 1 : 0);
  std::string digits = rounded.get_str();
  if (decimals > 0) {
    const auto places = static_cast<std::size_t>(decimals);
    if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
    digits.insert(digits.size() - places, ".");
  }
  return (value < 0 && rounded != 0 ? std::string(kMinus) : "") + with_commas(digits);
}

std::string rounded_text(double value) {
  constexpr double kMostFixed = 1e5;
  if (std::abs(value) < kMostFixed || !std::isfinite(value)) return fixed_text(value, 2);
  const std::string digits = fmt::format("{:.2e}", std::abs(value));
  const std::size_t e = digits.find('e');
  return fmt::format("{}{}×{}", value < 0 ? kMinus : "", digits.substr(0, e),
                     power_text(std::stol(digits.substr(e + 1))));
}

std::string power_text(long exponent) {
  constexpr std::array<std::string_view, 10> kDigits{"⁰", "¹", "²", "³", "⁴",
                                                     "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "10";
  for (const char c : std::to_string(exponent)) {
    text += c == '-' ? std::string_view("⁻") : kDigits[static_cast<std::size_t>(c - '0')];
  }
  return text;
}

std::string short_text(const Rational& value) {
  if (value.get_den() == 1 && abs(value) < 10'000'000) return fixed_text(to_double(value), 0);
  const Magnitude size = magnitude_of(abs(value));
  const std::string sign = value < 0 ? std::string(kMinus) : "";
  if (std::abs(size.exponent) > 2 && abs(value) == power_of_ten(size.exponent)) {
    return sign + power_text(size.exponent);
  }
  // Exactly as a decimal, if it is one of few digits.
  if (std::abs(size.exponent) <= 4) {
    for (int decimals = 1; decimals <= 4; ++decimals) {
      if (Rational(value * power_of_ten(decimals)).get_den() == 1) {
        return fixed_text(to_double(value), decimals);
      }
    }
  }
  constexpr std::size_t kShort = 7;
  const std::string fraction = Rational(abs(value)).get_str();
  if (fraction.size() + (value < 0 ? 1 : 0) <= kShort) return sign + fraction;
  if (size.exponent >= -2 && size.exponent < 7) {
    return fixed_text(to_double(value), std::max(0, 2 - static_cast<int>(size.exponent)));
  }
  const Magnitude rounded = written_with(2, size);
  return fmt::format("{}{:.2f}×{}", sign, rounded.mantissa, power_text(rounded.exponent));
}

Ticks ticks_of(double low, double high, double least) {
  constexpr double kMost = 1000;
  Ticks ticks;
  least = std::max(least, (high - low) / kMost);
  if (!(least > 0) || !std::isfinite(least)) return ticks;
  const double power = to_double(power_of_ten(std::lround(std::floor(rounded::log10(least)))));
  for (const double factor : {1, 2, 5, 10}) {
    ticks.step = factor * power;
    if (ticks.step >= least) break;
  }
  // Ticks are counted, so that rounding does not lose the last one.
  constexpr double kSlack = 1e-9;
  const double first = std::ceil(low / ticks.step - kSlack);
  const double last = std::floor(high / ticks.step + kSlack);
  // Beyond 2^53 neighbours cannot be told apart.
  constexpr double kMostExact = 1LL << 53;
  if (!(std::max(std::abs(first), std::abs(last)) < kMostExact)) return ticks;
  for (double n = first; n <= last; ++n) ticks.values.push_back(n * ticks.step);
  return ticks;
}

Ticks with_room_for_figures(Ticks ticks, const FigureAxis& axis, const Font& font) {
  const auto is_crowded = [&] {
    const double widest = std::max(font.width_em(tick_text(axis.low, ticks.step)),
                                   font.width_em(tick_text(axis.high, ticks.step)));
    return ticks.step < (widest + axis.gap_em) * axis.em;
  };
  while (ticks.values.size() > 1 && is_crowded()) {
    ticks = ticks_of(axis.low, axis.high, 1.5 * ticks.step);
  }
  return ticks;
}

std::string tick_text(double value, double step) {
  constexpr double kLeastPlain = 1e-4;
  constexpr double kMostPlain = 1e6;
  const double exponent = std::floor(rounded::log10(step) + 1e-9);
  if (step >= kLeastPlain && step < kMostPlain) {
    return fixed_text(value, static_cast<int>(std::max(0.0, -exponent)));
  }
  // A step is 1, 2 or 5 times a power of ten: values are whole multiples of that.
  const double multiple =
      std::round(value / step) * std::round(step / to_double(power_of_ten(std::lround(exponent))));
  const std::string text = fixed_text(multiple, 0);
  return multiple == 0 ? text : text + "×" + power_text(std::lround(exponent));
}

}  // namespace piblocks
