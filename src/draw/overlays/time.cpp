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

/// A scene that ends after a collision that never comes can still be seen at one instant.
bool has_end(const Setting& setting) {
  return setting.log.size() > 0 || !setting.scene.time.to.after_last;
}

/// Simulation time per second of video where it runs slowest; 1 at most.
double least_speed(const Setting& setting) {
  if (!has_end(setting)) return std::min(1.0, to_double(setting.scene.time.speed));
  double least = 1;
  const Schedule schedule(setting.scene, setting.log);
  for (const Stretch& stretch : schedule.stretches()) {
    if (stretch.speed != 0) least = std::min(least, std::abs(to_double(stretch.speed)));
  }
  return least;
}

/// More in slow motion, where less of time passes.
int decimals_for(double speed) {
  const double more = std::ceil(-std::log10(speed) - 1e-9);
  return static_cast<int>(std::clamp<double>(kDecimals + more, kDecimals, kMostDecimals));
}

}  // namespace

ReadOut time_read_out(const Setting& setting) {
  const int decimals = decimals_for(least_speed(setting));
  const auto text = [decimals](double time) {
    return fmt::format("t = {}", fixed_text(time, decimals));
  };
  double end = std::abs(to_double(setting.scene.time.from));
  if (has_end(setting)) {
    end = std::max(end, std::abs(to_double(end_of(setting.scene, setting.log))));
  }
  return {"time", text(-end), [=](const Shown& shown) { return text(to_double(shown.time)); },
          setting.palette.text};
}

}  // namespace piblocks
