#include "h264/intra_prediction.hpp"

#include <cstring>

namespace piblocks::h264 {
namespace {

constexpr int kMiddle = 128;

template <int side>
int sum_of(const std::uint8_t* samples, int step = 1) {
  int sum = 0;
  for (int i = 0; i < side; ++i) sum += samples[i * step];
  return sum;
}

/// The rounded mean of the samples that are there.
template <int side>
int mean(const Beside& beside) {
  if (beside.above == nullptr && beside.left == nullptr) return kMiddle;
  const int left = beside.left == nullptr ? 0 : sum_of<side>(beside.left, beside.left_step);
  const int above = beside.above == nullptr ? 0 : sum_of<side>(beside.above);
  if (beside.above == nullptr || beside.left == nullptr) return (above + left + side / 2) / side;
  return (above + left + side) / (2 * side);
}

template <int side>
void fill(int value, std::uint8_t* out, int stride) {
  for (int y = 0; y < side; ++y) std::memset(out + y * stride, value, side);
}

template <int side>
void predict(Prediction prediction, const Beside& beside, std::uint8_t* out, int stride) {
  if (prediction == Prediction::dc) return fill<side>(mean<side>(beside), out, stride);
  for (int y = 0; y < side; ++y, out += stride) {
    if (prediction == Prediction::vertical) {
      std::memcpy(out, beside.above, side);
    } else {
      std::memset(out, beside.left[y * beside.left_step], side);
    }
  }
}

Beside beside_of(const Borders& borders, int plane) {
  const Border& border = borders.planes[plane];
  return {borders.has_above ? border.above.data() : nullptr,
          borders.has_left ? border.left.data() : nullptr, 1};
}

/// 8.3.4.1 to 8.3.4.3: each quarter has a mean of its own. Those off the diagonal look to one side
/// only, if it is there.
void predict_chroma_dc(const Beside& plane, std::uint8_t* out) {
  constexpr int kHalf = kChromaSide / 2;
  for (int y = 0; y < kChromaSide; y += kHalf) {
    for (int x = 0; x < kChromaSide; x += kHalf) {
      Beside beside{plane.above == nullptr ? nullptr : plane.above + x,
                    plane.left == nullptr ? nullptr : plane.left + y, 1};
      if (x > y && beside.above != nullptr) beside.left = nullptr;
      if (y > x && beside.left != nullptr) beside.above = nullptr;
      fill<kHalf>(mean<kHalf>(beside), out + y * kChromaSide + x, kChromaSide);
    }
  }
}

}  // namespace

Square predict_square(Prediction prediction, const Beside& beside) {
  Square square;
  predict<4>(prediction, beside, square.data(), 4);
  return square;
}

void predict_luma(Prediction prediction, const Borders& borders, Samples& samples) {
  predict<kLumaSide>(prediction, beside_of(borders, 0), samples.plane(0), kLumaSide);
}

void predict_chroma(Prediction prediction, const Borders& borders, Samples& samples) {
  for (int plane = 1; plane < 3; ++plane) {
    const Beside beside = beside_of(borders, plane);
    if (prediction == Prediction::dc) {
      predict_chroma_dc(beside, samples.plane(plane));
    } else {
      predict<kChromaSide>(prediction, beside, samples.plane(plane), kChromaSide);
    }
  }
}

}  // namespace piblocks::h264
