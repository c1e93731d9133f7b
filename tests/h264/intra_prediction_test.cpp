// Predictions from neighbours, against their definitions in ITU-T H.264, 8.3.
#include "h264/intra_prediction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "support/property.hpp"

namespace piblocks::h264 {
namespace {

using Row = std::vector<int>;

/// The samples above and left; empty where the picture ends.
struct Sides {
  Row above;
  Row left;
};

int sum_of(std::span<const int> values) { return std::accumulate(values.begin(), values.end(), 0); }

/// 8.3.1.2.3, 8.3.3.3: the rounded mean of the samples that exist.
int mean(const Sides& sides) {
  const int count = static_cast<int>(sides.above.size() + sides.left.size());
  if (count == 0) return 128;
  return (sum_of(sides.above) + sum_of(sides.left) + count / 2) / count;
}

int predicted_at(PredMode mode, const Sides& sides, std::size_t x, std::size_t y) {
  if (mode == PredMode::vertical) return sides.above[x];
  if (mode == PredMode::horizontal) return sides.left[y];
  return mean(sides);
}

/// 8.3.4.1 to 8.3.4.3, of chroma.
int chroma_dc_at(const Sides& sides, std::size_t x, std::size_t y) {
  const auto half = [](const Row& side, std::size_t at) {
    return side.empty() ? Row{}
                        : Row(side.begin() + (at < 4 ? 0 : 4), side.begin() + (at < 4 ? 4 : 8));
  };
  const Row above = half(sides.above, x);
  const Row left = half(sides.left, y);
  const bool is_upper_right = x >= 4 && y < 4;
  const bool is_lower_left = x < 4 && y >= 4;
  if (is_upper_right && !above.empty()) return mean({above, {}});
  if (is_lower_left && !left.empty()) return mean({{}, left});
  return mean({above, left});
}

Borders random_borders(Random& random, bool has_above, bool has_left) {
  Borders borders{.has_above = has_above, .has_left = has_left, .planes = {}};
  for (Border& border : borders.planes) {
    std::ranges::generate(border.above, [&] { return random.byte(); });
    std::ranges::generate(border.left, [&] { return random.byte(); });
  }
  return borders;
}

Sides sides_of(const Borders& borders, int plane) {
  const Border& border = borders.planes[static_cast<std::size_t>(plane)];
  Sides sides;
  if (borders.has_above)
    sides.above.assign(border.above.begin(), border.above.begin() + side_of(plane));
  if (borders.has_left)
    sides.left.assign(border.left.begin(), border.left.begin() + side_of(plane));
  return sides;
}

class IntraPredictionTest : public testing::Test {
 protected:
  /// With and without neighbours, for every possible mode.
  void for_each_case(const std::function<void(PredMode, bool, bool)>& check) {
    constexpr int kTimes = 50;
    SCOPED_TRACE(random_.trace());
    for (int i = 0; i < 4 * kTimes; ++i) {
      const bool has_above = (i & 1) != 0;
      const bool has_left = (i & 2) != 0;
      for (const PredMode mode : {PredMode::vertical, PredMode::horizontal, PredMode::dc}) {
        if (is_possible(mode, has_above, has_left)) check(mode, has_above, has_left);
      }
    }
  }

  Random random_{83};
};

TEST_F(IntraPredictionTest, NeedsWhatItCopies) {
  for (const bool other : {false, true}) {
    EXPECT_TRUE(is_possible(PredMode::dc, other, !other));
    EXPECT_TRUE(is_possible(PredMode::vertical, true, other));
    EXPECT_FALSE(is_possible(PredMode::vertical, false, other));
    EXPECT_TRUE(is_possible(PredMode::horizontal, other, true));
    EXPECT_FALSE(is_possible(PredMode::horizontal, other, false));
  }
  EXPECT_TRUE(is_possible(PredMode::dc, false, false));
}

TEST_F(IntraPredictionTest, Predicts4x4Blocks) {
  for_each_case([&](PredMode mode, bool has_above, bool has_left) {
    const auto step = static_cast<std::size_t>(random_.integer(1, 16));
    std::array<std::uint8_t, 4> above{};
    std::array<std::uint8_t, 64> left{};
    std::ranges::generate(above, [&] { return random_.byte(); });
    std::ranges::generate(left, [&] { return random_.byte(); });
    Sides sides;
    if (has_above) sides.above.assign(above.begin(), above.end());
    for (std::size_t y = 0; y < 4 && has_left; ++y) sides.left.push_back(left[y * step]);

    const AdjacentSamples adjacent{has_above ? above.data() : nullptr,
                                   has_left ? left.data() : nullptr, static_cast<int>(step)};
    const Block4x4 block = predict_4x4(mode, adjacent);
    for (std::size_t i = 0; i < 16; ++i) {
      ASSERT_EQ(block[i], predicted_at(mode, sides, i % 4, i / 4))
          << static_cast<int>(mode) << " at " << i;
    }
  });
}

TEST_F(IntraPredictionTest, PredictsLumaAndNothingElse) {
  for_each_case([&](PredMode mode, bool has_above, bool has_left) {
    const Borders borders = random_borders(random_, has_above, has_left);
    Samples samples;
    samples.values.fill(77);
    predict_luma(mode, borders, samples);
    const Sides sides = sides_of(borders, 0);
    for (std::size_t i = 0; i < 256; ++i) {
      ASSERT_EQ(samples.values[i], predicted_at(mode, sides, i % 16, i / 16))
          << static_cast<int>(mode) << " at " << i;
    }
    EXPECT_TRUE(std::all_of(samples.values.begin() + 256, samples.values.end(),
                            [](int value) { return value == 77; }));
  });
}

TEST_F(IntraPredictionTest, PredictsChromaWithAMeanForEachQuarter) {
  for_each_case([&](PredMode mode, bool has_above, bool has_left) {
    const Borders borders = random_borders(random_, has_above, has_left);
    Samples samples;
    samples.values.fill(77);
    predict_chroma(mode, borders, samples);
    for (int plane = 1; plane < 3; ++plane) {
      const Sides sides = sides_of(borders, plane);
      for (std::size_t i = 0; i < 64; ++i) {
        const int expected = mode == PredMode::dc ? chroma_dc_at(sides, i % 8, i / 8)
                                                  : predicted_at(mode, sides, i % 8, i / 8);
        ASSERT_EQ(samples.plane(plane)[i], expected)
            << static_cast<int>(mode) << " at " << i << " of plane " << plane;
      }
    }
    EXPECT_TRUE(std::all_of(samples.values.begin(), samples.values.begin() + 256,
                            [](int value) { return value == 77; }));
  });
}

}  // namespace
}  // namespace piblocks::h264
