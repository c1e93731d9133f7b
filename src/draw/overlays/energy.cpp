#include <fmt/format.h>

#include <cmath>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

constexpr int kDigits = 6;  // of the sum

/// How a sum that never changes is written, and what its parts are multiplied with.
struct Scale {
  double sum = 0;
  int decimals = 0;
  std::string unit;  ///< such as " ×10⁹", or nothing
};

Scale scale_of(const Rational& sum) {
  const Magnitude size = magnitude_of(sum);
  const bool is_plain = size.exponent >= -2 && size.exponent < kDigits;
  if (!is_plain) return {size.mantissa, kDigits - 1, " ×10" + superscript(size.exponent)};
  return {to_double(sum), kDigits - 1 - static_cast<int>(size.exponent), ""};
}

}  // namespace

ReadOut energy_read_out(const Setting& setting) {
  const BlockSystem& system = setting.scene.system;
  const auto energy = [](const Block& block) {
    return Rational(block.mass * block.velocity * block.velocity / 2);
  };
  const Scale scale = scale_of(energy(system.blue) + energy(system.red));
  const double ratio = to_double(system.blue.mass / system.red.mass);
  const auto text = [scale](double red, double blue) {
    return fmt::format("Energy{}: red {} + blue {} = {}", scale.unit,
                       fixed_text(red, scale.decimals), fixed_text(blue, scale.decimals),
                       fixed_text(scale.sum, scale.decimals));
  };
  return {text(scale.sum, scale.sum),
          [=](const Shown& shown) {
            // In parts of the sum: masses may be beyond a double.
            const double red = shown.state.red.velocity * shown.state.red.velocity;
            const double blue = ratio * shown.state.blue.velocity * shown.state.blue.velocity;
            const double whole = red + blue;
            if (!(whole > 0)) return text(0, 0);
            return text(scale.sum * (red / whole), scale.sum * (blue / whole));
          },
          setting.palette.text};
}

}  // namespace piblocks
