#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

constexpr int kDigits = 6;

}  // namespace

ReadOut momentum_read_out(const Setting& setting) {
  const BlockSystem& system = setting.scene.system;
  // The most that one block can have: all energy its own, and it the heavier one.
  const Rational twice_energy = system.blue.mass * system.blue.velocity * system.blue.velocity +
                                system.red.mass * system.red.velocity * system.red.velocity;
  const Rational most_squared = twice_energy * std::max(system.blue.mass, system.red.mass);
  const Magnitude most = written_with(kDigits - 1, root_magnitude_of(most_squared));
  const bool is_plain = most.exponent >= -2 && most.exponent < kDigits;
  const int decimals = is_plain ? kDigits - 1 - static_cast<int>(most.exponent) : kDigits - 1;
  const std::string power = is_plain ? "" : " ×10" + superscript(most.exponent);
  const char* const red_name = setting.palette.red.name;
  const char* const blue_name = setting.palette.blue.name;
  const auto text = [=](double red, double blue) {
    return fmt::format("Momentum{}: {} {}, {} {}, sum {}", power, red_name,
                       fixed_text(red, decimals), blue_name, fixed_text(blue, decimals),
                       fixed_text(red + blue, decimals));
  };

  const double largest =
      most.mantissa * (is_plain ? std::pow(10, static_cast<double>(most.exponent)) : 1);
  // In parts of the largest: masses may be beyond a double, and so may what a velocity of 1 gives.
  const auto factor = [&](const Block& block) -> mpf_class {
    if (most_squared == 0) return 0;
    return largest * wide_root_of(block.mass * block.mass / most_squared);
  };
  const mpf_class red_factor = factor(system.red);
  const mpf_class blue_factor = factor(system.blue);
  return {"momentum", text(-largest, -largest),
          [=](const FrameState& shown) {
            return text(mpf_class(red_factor * shown.state.red.velocity).get_d(),
                        mpf_class(blue_factor * shown.state.blue.velocity).get_d());
          },
          setting.palette.text};
}

}  // namespace piblocks
