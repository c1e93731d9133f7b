#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

constexpr int kDecimals = 2;
constexpr int kMostDecimals = 9;

/// Simulation time per second of video where it runs slowest; 1 at most.
double least_speed(const Setting& setting) {
  // A scene whose end never comes can still be shown at an instant.
  if (!has_span(setting.scene, setting.log))
    return std::min(1.0, to_double(setting.scene.time.speed));
  double least = 1;
  const Schedule schedule = make_schedule(setting.scene, setting.log);
  for (const Stretch& stretch : schedule.stretches()) {
    if (stretch.speed != 0) least = std::min(least, std::abs(to_double(stretch.speed)));
  }
  return least;
}

/// Slow motion has more, since less time passes from frame to frame.
int decimals_for(double speed) {
  const double more = std::ceil(-std::log10(speed) - 1e-9);
  return static_cast<int>(std::clamp<double>(kDecimals + more, kDecimals, kMostDecimals));
}

std::string slower_text(const Rational& slower) {
  if (slower == 1) return {};
  if (slower < 1) return fmt::format("{}× faster", short_text(1 / slower));
  return fmt::format("{}× slower", short_text(slower));
}

/// How values up to a largest one are written: with as many decimals as give the largest six
/// digits, and as multiples of a power of ten if it is very large or very small.
struct Scale {
  explicit Scale(const Magnitude& most)
      : largest(written_with(kDigits - 1, most)),
        is_plain(largest.exponent >= -2 && largest.exponent < kDigits),
        decimals(kDigits - 1 - (is_plain ? static_cast<int>(largest.exponent) : 0)),
        unit(is_plain ? "" : " ×" + power_text(largest.exponent)) {}

  std::string text(double value) const { return fixed_text(value, decimals); }

  static constexpr int kDigits = 6;
  Magnitude largest;
  bool is_plain;
  int decimals;
  std::string unit;
};

}  // namespace

ReadOut time_read_out(const Setting& setting) {
  const int decimals = decimals_for(least_speed(setting));
  const auto text = [decimals](const Rational& time) {
    return fmt::format("t = {}", fixed_text(time, decimals));
  };
  Rational end = 0;
  if (has_span(setting.scene, setting.log)) {
    const Span span = span_of(setting.scene, setting.log);
    end = std::max(Rational(abs(span.from)), Rational(abs(span.to)));
  }
  return {"time", text(-end), [=](const FrameState& shown) { return text(shown.time); },
          setting.palette.text};
}

bool has_slow_motion(const Pacing& pacing) {
  return pacing.automatic_slow_motion || !pacing.slow_motion.empty();
}

ReadOut slower_read_out(const Setting& setting) {
  const Pacing& pacing = setting.scene.pacing;
  ReadOut read_out{"slow motion",
                   {},
                   [](const FrameState& shown) { return slower_text(shown.slower); },
                   setting.palette.accent};
  const auto make_room = [&](const Rational& slower) {
    std::string text = slower_text(slower);
    if (setting.font.width_em(text) > setting.font.width_em(read_out.widest)) {
      read_out.widest = std::move(text);
    }
  };
  for (const SlowMotion& slow : pacing.slow_motion) make_room(slow.factor);
  if (pacing.automatic_slow_motion) make_room(kMaxAutomaticFactor);
  return read_out;
}

ReadOut energy_read_out(const Setting& setting) {
  const BlockSystem& system = setting.scene.system;
  const Rational exact_sum = twice_energy(system) / 2;
  const Scale scale(magnitude_of(exact_sum));
  const double sum = scale.is_plain ? to_double(exact_sum) : scale.largest.mantissa;
  const char* const red_name = setting.palette.red.name;
  const char* const blue_name = setting.palette.blue.name;
  const auto text = [=](double red, double blue) {
    return fmt::format("Energy{}: {} {} + {} {} = {}", scale.unit, red_name, scale.text(red),
                       blue_name, scale.text(blue), scale.text(sum));
  };
  // Red's velocity if it had all the energy. It may be beyond the range of a double.
  const mpf_class fastest = root_of(2 * exact_sum / system.red.mass);
  return {"energy", text(sum, sum),
          [=](const FrameState& shown) {
            const double share =
                fastest > 0 ? mpf_class(shown.state.red.velocity / fastest).get_d() : 0;
            const double red = sum * std::min(1.0, share * share);
            return text(red, sum - red);
          },
          setting.palette.text};
}

ReadOut momentum_read_out(const Setting& setting) {
  const BlockSystem& system = setting.scene.system;
  // The heavier block has the most momentum when it has all the energy.
  const Rational most_squared = twice_energy(system) * std::max(system.blue.mass, system.red.mass);
  const Scale scale(root_magnitude_of(most_squared));
  const char* const red_name = setting.palette.red.name;
  const char* const blue_name = setting.palette.blue.name;
  const auto text = [=](double red, double blue) {
    return fmt::format("Momentum{}: {} {}, {} {}, sum {}", scale.unit, red_name, scale.text(red),
                       blue_name, scale.text(blue), scale.text(red + blue));
  };
  const double most =
      scale.largest.mantissa * (scale.is_plain ? std::pow(10, double(scale.largest.exponent)) : 1);
  // Masses may be beyond the range of a double, and so may these factors.
  const auto momentum_per_velocity = [&](const Block& block) -> mpf_class {
    if (most_squared == 0) return 0;
    return most * root_of(block.mass * block.mass / most_squared);
  };
  const mpf_class red_factor = momentum_per_velocity(system.red);
  const mpf_class blue_factor = momentum_per_velocity(system.blue);
  return {"momentum", text(-most, -most),
          [=](const FrameState& shown) {
            return text(mpf_class(red_factor * shown.state.red.velocity).get_d(),
                        mpf_class(blue_factor * shown.state.blue.velocity).get_d());
          },
          setting.palette.text};
}

}  // namespace piblocks
