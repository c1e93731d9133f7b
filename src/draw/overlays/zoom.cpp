#include "draw/overlays/zoom.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/smooth_step.hpp"
#include "draw/number_text.hpp"

namespace piblocks {

double straight_log2(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // 0.5 <= mantissa < 1
  return exponent - 2 + 2 * mantissa;
}

double straight_exp2(double y) {
  const double whole = std::floor(y);
  return std::ldexp(1 + (y - whole), static_cast<int>(whole));
}

namespace {

/// From a moment on, up to the next step.
struct Level {
  double from_s;
  int level;
};

/// Adds the steps between two moments, by halving. @param last  the level at the second one
void add_steps(const std::function<int(double)>& level_at, double from_s, double to_s, int last,
               std::vector<Level>& levels) {
  constexpr double kStep_s = kZoomEase_s / (1 << 14);
  if (levels.back().level == last) return;
  if (to_s - from_s <= kStep_s) {
    levels.push_back({to_s, last});
    return;
  }
  const double middle_s = (from_s + to_s) / 2;
  add_steps(level_at, from_s, middle_s, level_at(middle_s), levels);
  add_steps(level_at, middle_s, to_s, last, levels);
}

/// The least level in the time of an ease from a moment on.
int least_level_from(const std::vector<Level>& levels, double from_s) {
  int least = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const bool is_over = i + 1 < levels.size() && levels[i + 1].from_s <= from_s;
    if (!is_over && levels[i].from_s <= from_s + kZoomEase_s) {
      least = std::min(least, levels[i].level);
    }
  }
  return least;
}

}  // namespace

/// The mean of least_level_from() over the time of an ease until now, weighted so that one step
/// follows smooth_step().
double eased_level(const std::function<int(double)>& level_at) {
  const int now = level_at(0);
  std::vector<Level> levels{{-kZoomEase_s, level_at(-kZoomEase_s)}};
  add_steps(level_at, -kZoomEase_s, 0, now, levels);
  add_steps(level_at, 0, kZoomEase_s, level_at(kZoomEase_s), levels);
  if (levels.size() == 1) return now;
  // Between these the least level stays.
  std::vector<double> moments{-kZoomEase_s, 0};
  for (const Level& level : levels) {
    for (const double at_s : {level.from_s, level.from_s - kZoomEase_s}) {
      if (-kZoomEase_s < at_s && at_s < 0) moments.push_back(at_s);
    }
  }
  std::ranges::sort(moments);
  double mean = 0;
  for (std::size_t i = 1; i < moments.size(); ++i) {
    const double share =
        smooth_step(-moments[i - 1] / kZoomEase_s) - smooth_step(-moments[i] / kZoomEase_s);
    mean += share * least_level_from(levels, (moments[i - 1] + moments[i]) / 2);
  }
  return mean;
}

Zoom::Zoom(long most_exponent, double plateau) : plateau_(plateau) {
  for (long exponent = 0; exponent <= most_exponent; ++exponent) {
    powers_.push_back(to_double(power_of_ten(exponent)));
  }
}

long Zoom::exponent_of(double zoom) const {
  return std::max<long>(1, std::ranges::upper_bound(powers_, zoom) - powers_.begin()) - 1;
}

double Zoom::factor_for(double room) const {
  if (room < powers_.at(1)) return std::max(1.0, room);
  const long exponent = exponent_of(room);
  if (exponent == most_exponent()) return powers_.back();
  const double mantissa = room / power(exponent);
  const double way = straight_log2(mantissa) / straight_log2(10);
  const double eased = smooth_step(std::clamp((way - plateau_) / (1 - plateau_), 0.0, 1.0));
  return std::min(room, power(exponent) * straight_exp2(eased * straight_log2(10)));
}

}  // namespace piblocks
