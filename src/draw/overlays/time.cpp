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
  // A scene that ends after a collision that never comes can still be seen at one instant.
  if (!has_span(setting.scene, setting.log))
    return std::min(1.0, to_double(setting.scene.time.speed));
  double least = 1;
  const Schedule schedule = make_schedule(setting.scene, setting.log);
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

}  // namespace piblocks
