#include <fmt/format.h>
#include <piblocks/schedule.hpp>

#include <algorithm>
#include <cmath>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

constexpr int kDecimals = 2;
constexpr int kMostDecimals = 9;

/// More in slow motion, where less of time passes.
int decimals_for(const Scene& scene) {
  Rational slowest = 1;
  for (const SlowMotion& slow : scene.pacing.slow_motion) slowest = std::max(slowest, slow.factor);
  double factor = to_double(slowest);
  if (scene.pacing.automatic_slow_motion) factor = std::max<double>(factor, kMaxAutomaticFactor);
  const double speed = to_double(scene.time.speed);
  const double more = std::ceil(std::log10(factor / std::min(1.0, speed)) - 1e-9);
  return static_cast<int>(std::clamp<double>(kDecimals + more, kDecimals, kMostDecimals));
}

}  // namespace

ReadOut time_read_out(const Setting& setting) {
  const int decimals = decimals_for(setting.scene);
  const auto text = [decimals](double time) {
    return fmt::format("t = {}", fixed_text(time, decimals));
  };
  const double end = std::max(std::abs(to_double(setting.scene.time.from)),
                              std::abs(to_double(end_of(setting.scene, setting.log))));
  return {text(-end), [=](const Shown& shown) { return text(to_double(shown.time)); },
          setting.palette.text};
}

}  // namespace piblocks
