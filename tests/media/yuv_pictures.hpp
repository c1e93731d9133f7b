// Pictures of YCbCr to convert into, and what exact arithmetic makes of a colour.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "media/pixels/yuv.hpp"

namespace piblocks {

template <typename Sample>
struct SamplePlane {
  SamplePlane(int width, int height, Sample filling)
      : width_px(width), samples(std::size_t(width) * std::size_t(height), filling) {}
  Sample at(int x, int y) const { return samples[std::size_t(y * width_px + x)]; }
  PlaneView<Sample> view() {
    return {samples.data(), width_px * static_cast<std::ptrdiff_t>(sizeof(Sample))};
  }
  bool operator==(const SamplePlane&) const = default;

  int width_px;
  std::vector<Sample> samples;
};

template <typename Sample>
struct YuvPicture {
  /// @param chroma  pixels to a sample of chroma, in each direction
  YuvPicture(int width, int height, int chroma, Sample filling = 0)
      : y(width, height, filling),
        cb(width / chroma, height / chroma, filling),
        cr(width / chroma, height / chroma, filling),
        alpha(width, height, filling) {}
  YuvView<Sample> view() { return {y.view(), cb.view(), cr.view(), alpha.view()}; }
  bool operator==(const YuvPicture&) const = default;

  SamplePlane<Sample> y, cb, cr, alpha;
};

struct ExactYuv {
  long double y, cb, cr;
};

/// ITU-R BT.709-6, 3.2 to 3.4, of levels 0 to `white`, in limited range of so many bits.
inline ExactYuv bt709(long double red, long double green, long double blue, long double white = 255,
                      int bits = 8) {
  const long double one = std::exp2(static_cast<long double>(bits - 8));
  const long double luma = 0.2126L * red + 0.7152L * green + 0.0722L * blue;
  return {one * (16 + 219 * luma / white), one * (128 + 224 * (blue - luma) / 1.8556L / white),
          one * (128 + 224 * (red - luma) / 1.5748L / white)};
}

}  // namespace piblocks
