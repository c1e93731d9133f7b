// sRGB and linear light.
// In: samples of 0 … 255, not necessarily whole. Out: light of 0 … 1, and back.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace piblocks {

/// x^2.4 for 0 < x <= 1, by Newton's method for the fifth root of x^2, from above. std::pow() would
/// round differently on other machines.
constexpr double power_2_4(double x) {
  const double square = x * x;
  double root = 1;
  for (double next = root;; root = next) {
    const double fourth = root * root * root * root;
    next = (4 * root + square / fourth) / 5;
    if (next >= root) return square * root;
  }
}

/// The transfer function of IEC 61966-2-1. @param share  of the greatest sample, 0 … 1
constexpr double light_of(double share) {
  return share <= 0.04045 ? share / 12.92 : power_2_4((share + 0.055) / 1.055);
}

/// The same from a table of four values a step, linear between them.
/// The error is less than 1/1000 of a step.
class Light {
 public:
  Light() {
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const double v = double(i) / double(255 * kPerStep);
      table_[i] = light_of(v);
    }
    for (std::size_t i = 0; i < units_.size(); ++i) {
      units_[i] = static_cast<std::int64_t>(of(double(i) / kUnitsPerStep) * kLightUnit);
    }
    for (std::size_t part = 0; part < first_samples_.size(); ++part) {
      first_samples_[part] = search(double(part) / kParts);
    }
  }

  double of(double sample) const {
    const double at = std::clamp(sample, 0.0, 255.0) * double(kPerStep);
    const auto i = std::min(static_cast<std::size_t>(at), table_.size() - 2);
    return table_[i] + (table_[i + 1] - table_[i]) * (at - double(i));
  }
  /// The same in whole numbers of 1 / kLightUnit, of the nearest sixteenth of a step.
  std::int64_t units_of(double sample) const {
    const double at = std::clamp(sample, 0.0, 255.0) * kUnitsPerStep + 0.5;
    return units_[static_cast<std::size_t>(at)];
  }
  /// The nearest sample.
  std::uint8_t sample(double light) const {
    const double part = std::clamp(light, 0.0, 1.0) * kParts;
    std::size_t sample = first_samples_[static_cast<std::size_t>(part)];
    while (sample < 255 && light >= begin_of(sample + 1)) ++sample;
    return static_cast<std::uint8_t>(sample);
  }

  static constexpr double kLightUnit = 1 << 30;

 private:
  /// The least light that is nearest to this sample.
  double begin_of(std::size_t sample) const { return table_[sample * kPerStep - kPerStep / 2]; }
  /// The nearest sample, by halving.
  std::uint8_t search(double light) const {
    std::size_t sample = 0;
    for (std::size_t step = 128; step > 0; step /= 2) {
      if (light >= begin_of(sample + step)) sample += step;
    }
    return static_cast<std::uint8_t>(sample);
  }
  static constexpr std::size_t kPerStep = 4;
  static constexpr std::size_t kUnitsPerStep = 16;
  static constexpr std::size_t kParts = 4096;
  std::array<double, 255 * kPerStep + 1> table_{};
  std::array<std::int64_t, 255 * kUnitsPerStep + 1> units_{};
  std::array<std::uint8_t, kParts + 1>
      first_samples_{};  ///< nearest to where each part of the light begins
};

}  // namespace piblocks
