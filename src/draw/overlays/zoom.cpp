#include "draw/overlays/zoom.hpp"

#include <algorithm>
#include <cmath>

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
