// sRGB and linear light.
// In: samples of 0 … 255, not necessarily whole. Out: light of 0 … 1, and back.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace piblocks {

/// The transfer function of IEC 61966-2-1, from a table of four values a step, linear between them.
/// The error is less than 1/1000 of a step.
class Light {
 public:
  Light() {
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const double v = double(i) / (255 * kPerStep);
      table_[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
  }

  double of(double sample) const {
    const double at = std::clamp(sample, 0.0, 255.0) * kPerStep;
    const auto i = std::min(static_cast<std::size_t>(at), table_.size() - 2);
    return table_[i] + (table_[i + 1] - table_[i]) * (at - double(i));
  }
  /// The nearest sample.
  static std::uint8_t sample(double light) {
    const double l = std::clamp(light, 0.0, 1.0);
    const double v = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * v));
  }

 private:
  static constexpr int kPerStep = 4;
  std::array<double, 255 * kPerStep + 1> table_{};
};

}  // namespace piblocks
