// The transform and the quantiser, against a plain reading of ITU-T H.264, 8.5.
#include "h264/transform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "h264/random_pictures.hpp"
#include "support/traced_random.hpp"

namespace piblocks::h264 {
namespace {

/// [row][column]
using Matrix = std::array<std::array<int, 4>, 4>;

constexpr Matrix kForward = {{{1, 1, 1, 1}, {2, 1, -1, -2}, {1, -1, -1, 1}, {1, -2, 2, -1}}};
/// Decoders compute with 16 bits. From the next QP on, a level rounded up may exceed them if a
/// whole block differs by about 255.
constexpr int kLastQpIn16Bits = 48;
constexpr std::array kRoundings = {Rounding::intra, Rounding::inter};

Matrix transposed(const Matrix& m) {
  Matrix result{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = m[j][i];
  }
  return result;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

Matrix forward(const Block4x4& source, const Block4x4& predicted) {
  Matrix difference{};
  for (std::size_t i = 0; i < 16; ++i) difference[i / 4][i % 4] = source[i] - predicted[i];
  return product(product(kForward, difference), transposed(kForward));
}

Matrix matrix_of(const Coefficients& columns) {
  Matrix result{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = columns[j][i];
  }
  return result;
}

/// normAdjust4x4(m, i, j), 8.5.9.
int norm(int qp, std::size_t i, std::size_t j) {
  constexpr int kNorms[6][3] = {{10, 16, 13}, {11, 18, 14}, {13, 20, 16},
                                {14, 23, 18}, {16, 25, 20}, {18, 29, 23}};
  const int place = i % 2 == 0 && j % 2 == 0 ? 0 : i % 2 == 1 && j % 2 == 1 ? 1 : 2;
  return kNorms[qp % 6][place];
}

/// LevelScale4x4 with weightScale4x4 of 16 throughout.
int level_scale(int qp, std::size_t i, std::size_t j) { return 16 * norm(qp, i, j); }

/// The factor from coefficients to levels, times 2^15: the inverse of the norm, and of 16, 25 or 20
/// for the transform there and back.
long long factor(int qp, std::size_t i, std::size_t j) {
  const int there_and_back = i % 2 == 0 && j % 2 == 0 ? 16 : i % 2 == 1 && j % 2 == 1 ? 25 : 20;
  return std::llround(std::ldexp(1, 21) / (norm(qp, i, j) * there_and_back));
}

long long rounding_of(int qp, Rounding rounding) {
  return (1LL << (15 + qp / 6)) / (rounding == Rounding::intra ? 3 : 6);
}

int quantised(int coefficient, int qp, Rounding rounding, std::size_t i, std::size_t j) {
  const long long size =
      (std::llabs(coefficient) * factor(qp, i, j) + rounding_of(qp, rounding)) >> (15 + qp / 6);
  return static_cast<int>(coefficient < 0 ? -size : size);
}

/// 8.5.12.1
int scaled(int level, int qp, std::size_t i, std::size_t j) {
  const int scale = level_scale(qp, i, j);
  if (qp >= 24) return (level * scale) * (1 << (qp / 6 - 4));
  return (level * scale + (1 << (3 - qp / 6))) >> (4 - qp / 6);
}

/// Figure 8-8 (a): where the k-th level is, 4 times its row and its column.
constexpr std::array<std::size_t, 16> kZigZag = {0, 1,  4,  8,  5, 2,  3,  6,
                                                 9, 12, 13, 10, 7, 11, 14, 15};

/// The largest of the numbers that a conforming stream keeps within 16 bits (8.5.12.2).
class Range {
 public:
  int operator()(int value) {
    largest = std::max({largest, value, -value - 1});
    return value;
  }
  int largest = 0;
};

std::array<int, 4> inverse_line(const std::array<int, 4>& d, Range& range) {
  const int e0 = range(d[0] + d[2]);
  const int e1 = range(d[0] - d[2]);
  const int e2 = range((d[1] >> 1) - d[3]);
  const int e3 = range(d[1] + (d[3] >> 1));
  return {range(e0 + e3), range(e1 + e2), range(e1 - e2), range(e0 - e3)};
}

/// 8.5.12.2 and 8.5.14
Block4x4 inverse(const Matrix& d, const Block4x4& predicted, Range& range) {
  Matrix f{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (const int value : d[i]) range(value);
    f[i] = inverse_line(d[i], range);
  }
  Matrix h = transposed(f);
  for (std::array<int, 4>& column : h) column = inverse_line(column, range);
  Block4x4 block{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const int residual = range(h[j][i] + 32) >> 6;
      block[4 * i + j] =
          static_cast<std::uint8_t>(std::clamp(predicted[4 * i + j] + residual, 0, 255));
    }
  }
  return block;
}

struct Pair {
  Block4x4 source;
  Block4x4 predicted;
};

/// Large or small differences, everywhere or at some samples, and the largest ones.
Pair random_pair(Random& random) {
  Pair pair{};
  const std::int64_t most = std::int64_t{1} << random.integer(0, 8);
  const std::int64_t kind = random.integer(0, 3);
  for (std::size_t i = 0; i < 16; ++i) {
    pair.predicted[i] = random.byte();
    pair.source[i] = clamped(pair.predicted[i] + random.integer(-most, most));
    if (kind == 1 && random.integer(0, 3) > 0) pair.source[i] = pair.predicted[i];
    if (kind == 2) pair.source[i] = random.integer(0, 1) == 0 ? 0 : 255;
    if (kind == 2) pair.predicted[i] = static_cast<std::uint8_t>(255 - pair.source[i]);
  }
  return pair;
}

/// Differences of 255 throughout, their signs by the bits of a number.
Pair extreme_pair(unsigned signs) {
  Pair pair{};
  for (std::size_t i = 0; i < 16; ++i) {
    pair.source[i] = (signs >> i & 1) != 0 ? 255 : 0;
    pair.predicted[i] = static_cast<std::uint8_t>(255 - pair.source[i]);
  }
  return pair;
}

std::string name_of(int qp, Rounding rounding) {
  return "QP " + std::to_string(qp) + (rounding == Rounding::intra ? " intra" : " inter");
}

/// Checks every step for one block, and notes how large its numbers get.
void check_block(const Quantiser& quantiser, int qp, Rounding rounding, const Pair& pair,
                 Range& range) {
  const Matrix wanted = forward(pair.source, pair.predicted);
  Coefficients coefficients = transform_difference(pair.source, pair.predicted);
  ASSERT_EQ(matrix_of(coefficients), wanted);

  Levels expected{};
  Matrix scaled_levels{};
  for (std::size_t k = 0; k < 16; ++k) {
    const std::size_t i = kZigZag[k] / 4;
    const std::size_t j = kZigZag[k] % 4;
    const int level = quantised(wanted[i][j], qp, rounding, i, j);
    expected[k] = static_cast<std::int16_t>(level);
    scaled_levels[i][j] = scaled(level, qp, i, j);
  }
  Levels levels;
  levels.fill(99);
  const int total = quantiser.quantise(coefficients, levels);
  ASSERT_EQ(levels, expected);
  ASSERT_EQ(total, 16 - std::ranges::count(expected, 0));

  const Block4x4 shown = inverse(scaled_levels, pair.predicted, range);
  if (total == 0) {
    ASSERT_EQ(shown, pair.predicted);
  } else {
    ASSERT_EQ(matrix_of(coefficients), scaled_levels);
    ASSERT_EQ(add_inverse(coefficients, pair.predicted), shown);
  }
}

/// Every QP and rounding.
void for_each_quantiser(const std::function<void(const Quantiser&, int, Rounding)>& check) {
  for (int qp = 0; qp <= 51; ++qp) {
    for (const Rounding rounding : kRoundings) {
      SCOPED_TRACE(name_of(qp, rounding));
      check(Quantiser(qp, rounding), qp, rounding);
    }
  }
}

TEST(Transform, DoesWhatTheClausesSayForEveryQp) {
  constexpr int kBlocks = 500;
  TracedRandom random(85);
  for_each_quantiser([&](const Quantiser& quantiser, int qp, Rounding rounding) {
    Range range;
    for (int i = 0; i < kBlocks; ++i) {
      ASSERT_NO_FATAL_FAILURE(check_block(quantiser, qp, rounding, random_pair(random), range));
    }
    EXPECT_LT(range.largest, 1 << (qp <= kLastQpIn16Bits ? 15 : 16));
  });
}

TEST(Transform, StaysWithin16BitsForTheLargestDifferences) {
  constexpr unsigned kSigns = 1 << 16;
  constexpr unsigned kStep = 17;  // the QPs begin at different signs
  for_each_quantiser([&](const Quantiser& quantiser, int qp, Rounding rounding) {
    Range range;
    for (unsigned signs = static_cast<unsigned>(qp) % kStep; signs < kSigns; signs += kStep) {
      ASSERT_NO_FATAL_FAILURE(check_block(quantiser, qp, rounding, extreme_pair(signs), range));
    }
    EXPECT_LT(range.largest, 1 << (qp <= kLastQpIn16Bits ? 15 : 16));
  });
}

/// Coefficients of every size that a block can have, one at a time.
TEST(Transform, MultipliesCoefficientsOfEverySize) {
  for (int qp = 0; qp <= 51; ++qp) {
    const Quantiser quantiser(qp, Rounding::intra);
    for (std::size_t place = 0; place < 16; ++place) {
      const std::size_t i = kZigZag[place] / 4;
      const std::size_t j = kZigZag[place] % 4;
      const int weight = (i % 2 == 0 ? 4 : 6) * (j % 2 == 0 ? 4 : 6);
      for (int value = -255 * weight; value <= 255 * weight; value += 251) {
        Coefficients coefficients{};
        coefficients[j][static_cast<int>(i)] = value;
        Levels levels;
        const int total = quantiser.quantise(coefficients, levels);
        const int level = quantised(value, qp, Rounding::intra, i, j);
        ASSERT_EQ(levels[place], level) << "QP " << qp << ", " << value << " at " << place;
        if (total == 0) continue;
        ASSERT_EQ(coefficients[j][static_cast<int>(i)], scaled(level, qp, i, j))
            << "QP " << qp << ", " << value << " at " << place;
      }
    }
  }
}

TEST(ChromaDc, DoesWhatTheClausesSayForEveryQp) {
  constexpr int kBlocks = 2000;
  constexpr int kMost = 16 * 255;
  TracedRandom random(8511);
  for (int qp = 0; qp <= 51; ++qp) {
    const Rounding rounding = kRoundings[static_cast<std::size_t>(random.integer(0, 1))];
    const Quantiser quantiser(qp, rounding);
    for (int n = 0; n < kBlocks; ++n) {
      std::array<std::int32_t, 4> dc{};
      const std::int64_t most = n < 16 ? kMost : kMost >> random.integer(0, 12);
      for (std::size_t i = 0; i < 4; ++i) {
        dc[i] = static_cast<std::int32_t>(n < 16 ? ((n >> i & 1) != 0 ? most : -most)
                                                 : random.integer(-most, most));
      }
      // 8.5.11.1: rows and columns of (1, 1), (1, -1).
      const auto hadamard = [](const std::array<int, 4>& c) -> std::array<int, 4> {
        return {c[0] + c[1] + c[2] + c[3], c[0] - c[1] + c[2] - c[3], c[0] + c[1] - c[2] - c[3],
                c[0] - c[1] - c[2] + c[3]};
      };
      std::array<int, 4> expected{};
      const std::array<int, 4> sums = hadamard(dc);
      for (std::size_t i = 0; i < 4; ++i) {
        const long long size =
            (std::llabs(sums[i]) * factor(qp, 0, 0) + 2 * rounding_of(qp, rounding)) >>
            (16 + qp / 6);
        expected[i] = static_cast<int>(sums[i] < 0 ? -size : size);
      }
      std::array<std::int16_t, 4> levels{};
      const int total = quantiser.quantise_chroma_dc(dc, levels);
      ASSERT_TRUE(std::ranges::equal(levels, expected)) << "QP " << qp;
      ASSERT_EQ(total, 4 - std::ranges::count(expected, 0));
      const std::array<int, 4> f = hadamard(expected);
      for (std::size_t i = 0; i < 4; ++i) {
        // 8.5.11.2
        const int dc_scaled = ((f[i] * level_scale(qp, 0, 0)) * (1 << qp / 6)) >> 5;
        ASSERT_EQ(dc[i], dc_scaled) << "QP " << qp;
        ASSERT_LT(std::abs(dc_scaled), 1 << 15) << "QP " << qp;
      }
    }
  }
}

int levels_of(const Quantiser& quantiser, const Pair& pair) {
  Coefficients coefficients = transform_difference(pair.source, pair.predicted);
  Levels levels;
  return quantiser.quantise(coefficients, levels);
}

/// Spreads a sum of absolute differences over the samples that weigh most in a coefficient.
Pair worst_pair(int sum, std::size_t i, std::size_t j) {
  Pair pair{};
  int most = 0;
  for (std::size_t n = 0; n < 16; ++n) {
    most = std::max(most, std::abs(kForward[i][n / 4] * kForward[j][n % 4]));
  }
  for (std::size_t n = 0; n < 16; ++n) {
    const int weight = kForward[i][n / 4] * kForward[j][n % 4];
    if (std::abs(weight) < most) continue;
    const int part = std::min(sum, 255);
    sum -= part;
    (weight > 0 ? pair.source : pair.predicted)[n] = static_cast<std::uint8_t>(part);
  }
  return pair;
}

TEST(NegligibleSum, LeavesNoLevel) {
  TracedRandom random(1);
  for_each_quantiser([&](const Quantiser& quantiser, int, Rounding) {
    const int sum = quantiser.negligible_sum();
    for (std::size_t place = 0; place < 16; ++place) {
      EXPECT_EQ(levels_of(quantiser, worst_pair(sum, place / 4, place % 4)), 0) << place;
    }
    for (int n = 0; n < 200; ++n) {
      Pair pair = random_pair(random);
      int left = sum;
      for (std::size_t i = 0; i < 16; ++i) {
        const int difference = std::clamp(pair.source[i] - pair.predicted[i], -left, left);
        pair.source[i] = static_cast<std::uint8_t>(pair.predicted[i] + difference);
        left -= std::abs(difference);
      }
      ASSERT_LE(sum_of_differences(pair.source, pair.predicted), sum);
      EXPECT_EQ(levels_of(quantiser, pair), 0);
    }
  });
}

TEST(NegligibleSum, IsTheLargestOne) {
  for_each_quantiser([&](const Quantiser& quantiser, int, Rounding) {
    int levels = 0;
    for (std::size_t place = 0; place < 16; ++place) {
      const Pair pair = worst_pair(quantiser.negligible_sum() + 1, place / 4, place % 4);
      levels += levels_of(quantiser, pair);
    }
    EXPECT_GT(levels, 0);
  });
}

}  // namespace
}  // namespace piblocks::h264
