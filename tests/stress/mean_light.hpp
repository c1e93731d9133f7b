// The mean of pictures in linear light, computed apart from the program.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "draw/canvas.hpp"
#include "draw/composition.hpp"
#include "scene/run_log.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// Samples are in steps of 255, of sRGB (IEC 61966-2-1).
inline double to_light(double sample) {
  const double v = sample / 255;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

inline double to_sample(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

/// Of some rows, three a pixel, without alpha. Plain pointers: sanitizers look at each of thousands
/// of pictures, too.
inline std::vector<int> samples_of(const ImageView& picture, const std::vector<int>& rows) {
  std::vector<int> samples(3 * static_cast<std::size_t>(picture.width_px) * rows.size());
  int* to = samples.data();
  for (const int row : rows) {
    const std::uint8_t* pixel = picture.row(row);
    for (int x = 0; x < picture.width_px; ++x, pixel += 4) to = std::copy_n(pixel, 3, to);
  }
  return samples;
}

inline std::vector<int> samples_of(const ImageView& picture) {
  std::vector<int> rows(static_cast<std::size_t>(picture.height_px));
  std::iota(rows.begin(), rows.end(), 0);
  return samples_of(picture, rows);
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

constexpr int kInstants = 1000;

/// The mean of the pictures of many instants at which a frame's shutter is open.
/// @param samples  those of a picture that count
template <typename Samples>
std::vector<double> mean_of_instants(const Scene& open, std::int64_t frame,
                                     const Samples& samples) {
  Scene scene = open;
  scene.view.shutter = 0;
  const auto log = log_of(scene);
  const Schedule schedule = make_schedule(scene, *log);
  const Composition composition(scene, *log);
  const Integer count = log->count_at(schedule.time_of(frame));
  MeanLight mean;
  Canvas canvas(scene.view.width_px, scene.view.height_px);
  for (int i = 0; i < kInstants; ++i) {
    const Rational video_s =
        (frame + open.view.shutter * Rational(2 * i + 1, 2 * kInstants)) / scene.view.frame_rate;
    const Rational time = schedule.at(video_s).time;
    FrameState shown{.state = log->state_at(time), .time = time};
    shown.state.count = count;
    canvas.update(composition.frame(shown));
    mean.add(samples(canvas.view()));
  }
  return mean.samples();
}

struct LightDifference {
  /// Steps of 255. Near black these are finer than the light of a single instant; steps of that
  /// size take their place.
  double worst = 0;
  double mean = 0;
};

inline LightDifference difference_of(const std::vector<int>& samples,
                                     const std::vector<double>& wanted) {
  LightDifference difference;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double light = std::fabs(to_light(samples[i]) - to_light(wanted[i]));
    const double apart = std::min(std::fabs(samples[i] - wanted[i]), kInstants * light);
    difference.worst = std::max(difference.worst, apart);
    difference.mean += apart / double(samples.size());
  }
  return difference;
}

}  // namespace piblocks
