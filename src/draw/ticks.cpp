#include "draw/ticks.hpp"

#include <algorithm>
#include <cmath>

#include "draw/number_text.hpp"

namespace piblocks {

Ticks ticks_of(double low, double high, double least) {
  constexpr double kMost = 1000;
  Ticks ticks;
  least = std::max(least, (high - low) / kMost);
  if (!(least > 0) || !std::isfinite(least)) return ticks;
  const double power = std::pow(10, std::floor(std::log10(least)));
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
  const double exponent = std::floor(std::log10(step) + 1e-9);
  if (step >= kLeastPlain && step < kMostPlain) {
    return fixed_text(value, static_cast<int>(std::max(0.0, -exponent)));
  }
  // A step is 1, 2 or 5 times a power of ten: values are whole multiples of that.
  const double multiple = std::round(value / step) * std::round(step / std::pow(10, exponent));
  const std::string text = fixed_text(multiple, 0);
  return multiple == 0 ? text : text + "×" + power_text(std::lround(exponent));
}

Rational round_step(const Rational& least) {
  const Rational power = power_of_ten(magnitude_of(least).exponent);
  for (const int factor : {1, 2, 5}) {
    if (factor * power >= least) return factor * power;
  }
  return 10 * power;
}

}  // namespace piblocks
