#include "h264/transform.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace piblocks::h264 {
namespace {

/// Zig-zag (figure 8-8, table 8-13): entry k is the place of the k-th level, column by column.
constexpr std::array<int, 16> kScan = {0, 4, 1, 2, 5, 8, 12, 9, 6, 3, 7, 10, 13, 14, 11, 15};

/// By QP mod 6, for places with both coordinates even, both odd, and all others.
using ByPlace = std::array<int, 3>;
/// normAdjust4x4, 8.5.9.
constexpr std::array<ByPlace, 6> kScales = {
    {{10, 16, 13}, {11, 18, 14}, {13, 20, 16}, {14, 23, 18}, {16, 25, 20}, {18, 29, 23}}};
/// The inverse of these and of the transform's norms, times 2^15.
constexpr std::array<ByPlace, 6> kFactors = {{{13107, 5243, 8066},
                                              {11916, 4660, 7490},
                                              {10082, 4194, 6554},
                                              {9362, 3647, 5825},
                                              {8192, 3355, 5243},
                                              {7282, 2893, 4559}}};

Coefficients by_place(const ByPlace& values) {
  const auto [even, odd, mixed] = values;
  const Row first = {even, mixed, even, mixed};
  const Row second = {mixed, odd, mixed, odd};
  return {first, second, first, second};
}

Coefficients transposed(const Coefficients& m) {
  const Row low_01 = __builtin_shufflevector(m[0], m[1], 0, 4, 1, 5);
  const Row low_23 = __builtin_shufflevector(m[2], m[3], 0, 4, 1, 5);
  const Row high_01 = __builtin_shufflevector(m[0], m[1], 2, 6, 3, 7);
  const Row high_23 = __builtin_shufflevector(m[2], m[3], 2, 6, 3, 7);
  return {__builtin_shufflevector(low_01, low_23, 0, 1, 4, 5),
          __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7),
          __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5),
          __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7)};
}

/// The forward transform across the rows.
Coefficients transform(const Coefficients& v) {
  const Row a = v[0] + v[3];
  const Row b = v[1] + v[2];
  const Row c = v[1] - v[2];
  const Row d = v[0] - v[3];
  return {a + b, 2 * d + c, a - b, d - 2 * c};
}

/// The inverse, 8.5.12.2.
Coefficients inverse(const Coefficients& v) {
  const Row a = v[0] + v[2];
  const Row b = v[0] - v[2];
  const Row c = (v[1] >> 1) - v[3];
  const Row d = v[1] + (v[3] >> 1);
  return {a + d, b + c, b - c, a - d};
}

/// The transform of 2x2 values, which is its own inverse but for the size.
std::array<std::int32_t, 4> transform_2x2(const std::array<std::int32_t, 4>& v) {
  return {v[0] + v[1] + v[2] + v[3], v[0] - v[1] + v[2] - v[3], v[0] + v[1] - v[2] - v[3],
          v[0] - v[1] - v[2] + v[3]};
}

Row load(const Block4x4& block, int y) {
  using Four = std::uint8_t __attribute__((vector_size(4)));
  Four four;
  std::memcpy(&four, block.data() + 4 * y, sizeof four);
  return __builtin_convertvector(four, Row);
}

}  // namespace

int chroma_qp(int luma_qp) {
  constexpr std::array<std::uint8_t, 22> kFrom30 = {29, 30, 31, 32, 32, 33, 34, 34, 35, 35, 36,
                                                    36, 37, 37, 37, 38, 38, 38, 39, 39, 39, 39};
  return luma_qp < 30 ? luma_qp : kFrom30[luma_qp - 30];
}

Quantiser::Quantiser(int qp, Rounding rounding)
    : factors_(by_place(kFactors[qp % 6])),
      scales_(by_place(kScales[qp % 6])),
      shift_(15 + qp / 6),
      rounding_((1 << shift_) / (rounding == Rounding::intra ? 3 : 6)) {
  for (Row& row : scales_) row <<= qp / 6;
  const auto [even, odd, mixed] = kFactors[qp % 6];
  const std::int32_t least = (1 << shift_) - rounding_;  // of a product that is not negligible
  negligible_sum_ = (least - 1) / std::max({even, 4 * odd, 2 * mixed});
}

int Quantiser::quantise(Coefficients& coefficients, Levels& levels) const {
  Row any{};
  for (int i = 0; i < 4; ++i) {
    Row& row = coefficients[i];
    const Row sign = row >> 31;
    const Row size = (multiplied((row ^ sign) - sign, factors_[i]) + rounding_) >> shift_;
    row = (size ^ sign) - sign;
    any |= size;
  }
  levels = {};
  if ((any[0] | any[1] | any[2] | any[3]) == 0) return 0;

  std::array<std::int32_t, 16> values{};
  std::memcpy(values.data(), coefficients.data(), sizeof values);
  int total = 0;
  for (int k = 0; k < 16; ++k) {
    levels[k] = static_cast<std::int16_t>(values[kScan[k]]);
    total += levels[k] != 0 ? 1 : 0;
  }
  for (int i = 0; i < 4; ++i) coefficients[i] = multiplied(coefficients[i], scales_[i]);
  return total;
}

int Quantiser::quantise_chroma_dc(std::array<std::int32_t, 4>& dc,
                                  std::array<std::int16_t, 4>& levels) const {
  const std::array<std::int32_t, 4> sums = transform_2x2(dc);
  int total = 0;
  for (int i = 0; i < 4; ++i) {
    const int size = (std::abs(sums[i]) * factors_[0][0] + 2 * rounding_) >> (shift_ + 1);
    levels[i] = static_cast<std::int16_t>(sums[i] < 0 ? -size : size);
    total += size != 0 ? 1 : 0;
  }
  dc = transform_2x2({levels[0], levels[1], levels[2], levels[3]});
  // Flat scaling of 16: ((f * 16 * norm) << (QP / 6)) >> 5.
  for (std::int32_t& sum : dc) sum = sum * scales_[0][0] >> 1;
  return total;
}

Coefficients transform_difference(const Block4x4& source, const Block4x4& predicted) {
  Coefficients rows;
  for (int y = 0; y < 4; ++y) rows[y] = load(source, y) - load(predicted, y);
  return transform(transposed(transform(rows)));
}

Block4x4 add_inverse(Coefficients coefficients, const Block4x4& predicted) {
  coefficients = inverse(transposed(inverse(coefficients)));
  Block4x4 block;
  for (int y = 0; y < 4; ++y) {
    const Row sum = load(predicted, y) + ((coefficients[y] + 32) >> 6);
    for (int x = 0; x < 4; ++x) {
      block[4 * y + x] = static_cast<std::uint8_t>(std::clamp(sum[x], 0, 255));
    }
  }
  return block;
}

}  // namespace piblocks::h264
