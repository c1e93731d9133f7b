#include "h264/picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/traced_random.hpp"

namespace piblocks::h264 {
namespace {

constexpr int kWidth_mb = 3;
constexpr int kHeight_mb = 2;

Samples any_samples(Random& random) {
  Samples samples;
  std::ranges::generate(samples.values, [&] { return random.byte(); });
  return samples;
}

/// A sample of a plane of the whole picture.
std::uint8_t& at(Picture& picture, int plane, int x, int y) {
  return picture.plane(plane)[y * picture.stride_bytes(plane) + x];
}

class PictureTest : public testing::Test {
 protected:
  PictureTest() : picture_(kWidth_mb, kHeight_mb) {
    for (int plane = 0; plane < 3; ++plane) {
      for (int y = 0; y < kHeight_mb * side_of(plane); ++y) {
        for (int x = 0; x < kWidth_mb * side_of(plane); ++x) {
          at(picture_, plane, x, y) = random_.byte();
        }
      }
    }
  }

  Random random_{7};
  Picture picture_;
};

TEST_F(PictureTest, LoadsTheSamplesOfEveryMacroblock) {
  for (int address = 0; address < kWidth_mb * kHeight_mb; ++address) {
    const int x_mb = address % kWidth_mb;
    const int y_mb = address / kWidth_mb;
    Samples samples;
    picture_.load(x_mb, y_mb, samples);
    for (int plane = 0; plane < 3; ++plane) {
      const int side = side_of(plane);
      for (int i = 0; i < side * side; ++i) {
        ASSERT_EQ(samples.plane(plane)[i],
                  at(picture_, plane, x_mb * side + i % side, y_mb * side + i / side))
            << "sample " << i << " of plane " << plane << " of " << address;
      }
    }
  }
}

TEST_F(PictureTest, StoresOneMacroblockAndLeavesTheOthers) {
  for (int stored = 0; stored < kWidth_mb * kHeight_mb; ++stored) {
    Picture picture = picture_;
    const Samples samples = any_samples(random_);
    picture.store(stored % kWidth_mb, stored / kWidth_mb, samples);
    for (int address = 0; address < kWidth_mb * kHeight_mb; ++address) {
      Samples found;
      Samples before;
      picture.load(address % kWidth_mb, address / kWidth_mb, found);
      picture_.load(address % kWidth_mb, address / kWidth_mb, before);
      EXPECT_EQ(found.values, address == stored ? samples.values : before.values) << address;
    }
  }
}

TEST_F(PictureTest, KnowsWhatIsBesideAMacroblock) {
  for (int address = 0; address < kWidth_mb * kHeight_mb; ++address) {
    const int x_mb = address % kWidth_mb;
    const int y_mb = address / kWidth_mb;
    Borders borders;
    picture_.load_borders(x_mb, y_mb, borders);
    EXPECT_EQ(borders.has_left, x_mb > 0);
    EXPECT_EQ(borders.has_above, y_mb > 0);
    for (int plane = 0; plane < 3; ++plane) {
      const int side = side_of(plane);
      const Border& border = borders.planes[static_cast<std::size_t>(plane)];
      for (int i = 0; i < side; ++i) {
        const auto index = static_cast<std::size_t>(i);
        if (y_mb > 0) {
          EXPECT_EQ(border.above[index], at(picture_, plane, x_mb * side + i, y_mb * side - 1));
        }
        if (x_mb > 0) {
          EXPECT_EQ(border.left[index], at(picture_, plane, x_mb * side - 1, y_mb * side + i));
        }
      }
    }
  }
}

TEST(Samples, MeasuresHowMuchTheyDiffer) {
  TracedRandom random(8);
  for (int run = 0; run < 200; ++run) {
    Samples a = any_samples(random);
    Samples b = any_samples(random);
    if (run == 0) a.values.fill(0), b.values.fill(255);
    int luma = 0;
    int chroma = 0;
    int largest = 0;
    for (std::size_t i = 0; i < 384; ++i) {
      const int difference = a.values[i] - b.values[i];
      (i < 256 ? luma : chroma) += difference * difference;
      largest = std::max(largest, std::abs(difference));
    }
    EXPECT_EQ(luma_error(a, b), luma);
    EXPECT_EQ(chroma_error(a, b), chroma);
    EXPECT_EQ(largest_difference(a, b), largest);
    EXPECT_EQ(largest_difference(a, a), 0);
  }
}

TEST(Samples, FindsTheLargestDifferenceWhereverItIs) {
  for (std::size_t i = 0; i < 384; ++i) {
    Samples a;
    a.values.fill(100);
    Samples b = a;
    b.values[i] = 97;
    EXPECT_EQ(largest_difference(a, b), 3) << i;
    b.values[i] = 255;
    EXPECT_EQ(largest_difference(a, b), 155) << i;
  }
}

}  // namespace
}  // namespace piblocks::h264
