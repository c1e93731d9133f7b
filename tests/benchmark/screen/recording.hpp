// The pictures of an application in 4:2:0, kept in memory.
// In: a material. Out: planes, and the rectangles of each picture that may have changed.
#pragma once

#include <cstddef>
#include <vector>

#include "media/pixels/yuv.hpp"
#include "screen/material.hpp"

namespace piblocks::benchmark {

/// Y, then Cb, then Cr, without gaps between rows.
struct Picture {
  std::vector<std::uint8_t> samples;
  std::vector<PixelRect> changed;

  static constexpr std::size_t kLuma = std::size_t{kScreenWidth_px} * kScreenHeight_px;
  const std::uint8_t* y() const { return samples.data(); }
  const std::uint8_t* cb() const { return samples.data() + kLuma; }
  const std::uint8_t* cr() const { return samples.data() + kLuma + kLuma / 4; }
};

struct Recording {
  std::vector<Picture> pictures;
  double changed_share = 0;  ///< of all pixels after the first picture, by the rectangles
};

/// @throws Error if a picture differs from the last one outside of its rectangles.
Recording record(const Material& material);

}  // namespace piblocks::benchmark
