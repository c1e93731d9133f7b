#include <fmt/format.h>

#include <algorithm>

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
  const Magnitude size = written_with(kDigits - 1, magnitude_of(sum));
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
  const Rational sum = energy(system.blue) + energy(system.red);
  const Scale scale = scale_of(sum);
  const Palette& palette = setting.palette;
  const auto text = [scale, red_name = palette.red.name, blue_name = palette.blue.name](
                        double red, double blue) {
    return fmt::format("Energy{}: {} {} + {} {} = {}", scale.unit, red_name,
                       fixed_text(red, scale.decimals), blue_name, fixed_text(blue, scale.decimals),
                       fixed_text(scale.sum, scale.decimals));
  };
  // Red's velocity if it had all the energy. It may be beyond a double where red's velocity is not.
  const mpf_class fastest = wide_root_of(2 * sum / system.red.mass);
  return {"energy", text(scale.sum, scale.sum),
          [=](const FrameState& shown) {
            const double share =
                fastest > 0 ? mpf_class(shown.state.red.velocity / fastest).get_d() : 0;
            const double red = scale.sum * std::min(1.0, share * share);
            return text(red, scale.sum - red);
          },
          setting.palette.text};
}

}  // namespace piblocks
