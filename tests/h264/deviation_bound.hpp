// How far a quantiser may take the decoded samples from the source.
// In: a quantiser. Out: the most squared error that a macroblock of a plane can have.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "h264/stream_fixture.hpp"

namespace piblocks::h264 {

/// Root of the mean of the squared errors in a macroblock of one plane, at most. A coefficient is
/// off by 5/6 of a step at most (its dead zone), and the transform keeps squares. What is not
/// coded may be off by 1 + 2^(QP / 6) / 4, or twice that if it has moved. Rounding adds a little.
inline double largest_deviation(int qp) {
  const double power = std::exp2(qp / 6.0);
  const double coded = 0.625 * power * 5 / 6;
  const double not_coded = 2 * (1 + power / 4);
  return 1 + std::max(coded, not_coded);
}

/// "" if the decoder shows no macroblock farther from the source than a quantiser may take it; else
/// which one.
inline std::string excess(const Planes& source, int width_px, int height_px,
                          const ShownPicture& shown, int qp) {
  const std::array<Plane, 3> wanted = {source.y, source.cb, source.cr};
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const int step = plane == 0 ? 1 : 2;
    const int side = 16 / step;
    const double limit = side * side * largest_deviation(qp) * largest_deviation(qp);
    for (int top = 0; top < height_px / step; top += side) {
      for (int left = 0; left < width_px / step; left += side) {
        double sum = 0;
        for (int y = top; y < std::min(top + side, height_px / step); ++y) {
          const std::uint8_t* const a = wanted[plane].samples + y * wanted[plane].stride_bytes;
          const std::uint8_t* const b = shown.planes[plane] + y * shown.strides[plane];
          for (int x = left; x < std::min(left + side, width_px / step); ++x) {
            sum += (a[x] - b[x]) * (a[x] - b[x]);
          }
        }
        if (sum <= limit) continue;
        return "plane " + std::to_string(plane) + ", macroblock at " + std::to_string(left) + ", " +
               std::to_string(top) + ": squared error " + std::to_string(sum) + " at QP " +
               std::to_string(qp);
      }
    }
  }
  return {};
}

}  // namespace piblocks::h264
