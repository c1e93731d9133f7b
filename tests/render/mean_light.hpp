// The mean of pictures in linear light, computed apart from the program.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace piblocks {

/// Samples are in steps of 255, of sRGB (IEC 61966-2-1).
inline double to_light(int sample) {
  const double v = sample / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

inline double to_sample(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

/// Adds up samples of pictures, all in the same order.
class MeanLight {
 public:
  MeanLight() {
    for (int i = 0; i < 256; ++i) light_[static_cast<std::size_t>(i)] = to_light(i);
  }

  void add(const std::vector<int>& samples) {
    sums_.resize(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      sums_[i] += light_[static_cast<std::size_t>(samples[i])];
    }
    ++count_;
  }

  std::vector<double> samples() const {
    std::vector<double> samples;
    for (const double sum : sums_) samples.push_back(to_sample(sum / count_));
    return samples;
  }

 private:
  std::array<double, 256> light_{};
  std::vector<double> sums_;
  int count_ = 0;
};

}  // namespace piblocks
