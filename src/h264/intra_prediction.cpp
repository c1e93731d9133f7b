#include "h264/intra_prediction.hpp"

#include <cstring>

namespace piblocks::h264 {
namespace {

template <int side>
int sum_of(const std::uint8_t* samples, int step = 1) {
  int sum = 0;
  for (int i = 0; i < side; ++i) sum += samples[i * step];
  return sum;
}

/// The rounded mean of the samples that are there.
template <int side>
int mean(const AdjacentSamples& adjacent) {
  const auto [above, left, left_step] = adjacent;
  if (above == nullptr && left == nullptr) return 128;
  const int sum = (above == nullptr ? 0 : sum_of<side>(above)) +
                  (left == nullptr ? 0 : sum_of<side>(left, left_step));
  const bool is_one_side = above == nullptr || left == nullptr;
  return is_one_side ? (sum + side / 2) / side : (sum + side) / (2 * side);
}

template <int side>
void fill(int value, std::uint8_t* out, int stride) {
  for (int y = 0; y < side; ++y) std::memset(out + y * stride, value, side);
}

template <int side>
void predict(PredMode mode, const AdjacentSamples& adjacent, std::uint8_t* out, int stride) {
  if (mode == PredMode::dc) return fill<side>(mean<side>(adjacent), out, stride);
  for (int y = 0; y < side; ++y, out += stride) {
    if (mode == PredMode::vertical) {
      std::memcpy(out, adjacent.above, side);
    } else {
      std::memset(out, adjacent.left[y * adjacent.left_step], side);
    }
  }
}

AdjacentSamples adjacent_samples(const Borders& borders, int plane) {
  const Border& border = borders.planes[plane];
  return {borders.has_above ? border.above.data() : nullptr,
          borders.has_left ? border.left.data() : nullptr};
}

/// 8.3.4.1 to 8.3.4.3: each 4x4 block has a mean of its own. The blocks off the diagonal use one
/// side only, if it is there.
void predict_chroma_dc(const AdjacentSamples& plane, std::uint8_t* out) {
  for (int y = 0; y < kChromaSide; y += 4) {
    for (int x = 0; x < kChromaSide; x += 4) {
      AdjacentSamples adjacent{plane.above == nullptr ? nullptr : plane.above + x,
                               plane.left == nullptr ? nullptr : plane.left + y};
      if (x > y && adjacent.above != nullptr) adjacent.left = nullptr;
      if (y > x && adjacent.left != nullptr) adjacent.above = nullptr;
      fill<4>(mean<4>(adjacent), out + y * kChromaSide + x, kChromaSide);
    }
  }
}

}  // namespace

Block4x4 predict_4x4(PredMode mode, const AdjacentSamples& adjacent) {
  Block4x4 block;
  predict<4>(mode, adjacent, block.data(), 4);
  return block;
}

void predict_luma(PredMode mode, const Borders& borders, Samples& samples) {
  predict<kLumaSide>(mode, adjacent_samples(borders, 0), samples.plane(0), kLumaSide);
}

void predict_chroma(PredMode mode, const Borders& borders, Samples& samples) {
  for (int plane = 1; plane < 3; ++plane) {
    const AdjacentSamples adjacent = adjacent_samples(borders, plane);
    if (mode == PredMode::dc) {
      predict_chroma_dc(adjacent, samples.plane(plane));
    } else {
      predict<kChromaSide>(mode, adjacent, samples.plane(plane), kChromaSide);
    }
  }
}

}  // namespace piblocks::h264
