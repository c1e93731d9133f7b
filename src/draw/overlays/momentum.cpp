#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

constexpr int kDigits = 6;

/// sqrt(value) as mantissa and exponent.
Magnitude root(const Rational& value) {
  Magnitude size = magnitude_of(value);
  if (size.exponent % 2 != 0) {
    size.exponent -= 1;
    size.mantissa *= 10;
  }
  return {std::sqrt(size.mantissa), size.exponent / 2};
}

}  // namespace

ReadOut momentum_read_out(const Setting& setting) {
  const BlockSystem& system = setting.scene.system;
  // The most that one block can have: all energy its own, and it the heavier one.
  const Rational twice_energy = system.blue.mass * system.blue.velocity * system.blue.velocity +
                                system.red.mass * system.red.velocity * system.red.velocity;
  const Magnitude most = root(twice_energy * std::max(system.blue.mass, system.red.mass));
  const bool is_plain = most.exponent >= -2 && most.exponent < kDigits;
  const double unit = is_plain ? std::pow(10, static_cast<double>(most.exponent)) : 1;
  const int decimals = is_plain ? kDigits - 1 - static_cast<int>(most.exponent) : kDigits - 1;
  const std::string power = is_plain ? "" : " ×10" + superscript(most.exponent);
  const auto text = [=](double red, double blue) {
    return fmt::format("Momentum{}: red {}, blue {}, sum {}", power, fixed_text(red, decimals),
                       fixed_text(blue, decimals), fixed_text(red + blue, decimals));
  };

  const double ratio = to_double(system.blue.mass / system.red.mass);
  const double blue_start = to_double(system.blue.velocity);
  const double red_start = to_double(system.red.velocity);
  const double speed = std::sqrt(ratio * blue_start * blue_start + red_start * red_start);
  const double largest = most.mantissa * unit;
  const double red_factor = speed > 0 ? largest / (speed * std::max(1.0, std::sqrt(ratio))) : 0;
  return {text(-largest, -largest),
          [=](const Shown& shown) {
            return text(red_factor * shown.state.red.velocity,
                        red_factor * ratio * shown.state.blue.velocity);
          },
          setting.palette.text};
}

}  // namespace piblocks
