#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "media/yuv_pictures.hpp"
#include "support/article_frames.hpp"
#include "support/traced_random.hpp"

namespace piblocks {

void convert_to_yuv420_scalar(const ImageView& image, const PixelRect& rect,
                              const YuvView<std::uint8_t>& picture);

namespace {
using testing_support::Pixels;
using testing_support::random_frame;

/// How far a sample may be from the exact value; half of it is rounding to a whole number.
constexpr long double kTolerance = 0.53L;

using Picture = YuvPicture<std::uint8_t>;

Picture converted(const Pixels& pixels) {
  Picture picture(pixels.width_px, pixels.height_px, 2);
  convert_to_yuv420(pixels.view(), {0, 0, pixels.width_px, pixels.height_px}, picture.view());
  return picture;
}

ExactYuv bt709(std::uint32_t pixel) {
  return piblocks::bt709((pixel >> 16) & 0xff, (pixel >> 8) & 0xff, pixel & 0xff);
}

/// How far the chroma of a pixel is from the exact value.
long double chroma_error(const Picture& picture, int x, int y, const ExactYuv& exact) {
  return std::max(std::abs(picture.cb.at(x / 2, y / 2) - exact.cb),
                  std::abs(picture.cr.at(x / 2, y / 2) - exact.cr));
}

TEST(Yuv420, LumaIsRightForEveryColour) {
  Pixels pixels(4096, 4096);
  for (std::uint32_t i = 0; i < pixels.words.size(); ++i) pixels.words[i] = 0xff000000 | i;
  const Picture picture = converted(pixels);
  long double worst = 0;
  for (std::uint32_t i = 0; i < pixels.words.size(); ++i) {
    worst = std::max(worst, std::abs(picture.y.samples[i] - bt709(i).y));
  }
  EXPECT_LE(worst, kTolerance);
}

TEST(Yuv420, ChromaIsRightForFlatColours) {
  // Blocks of 4x2 pixels: the chroma sample on a block's third column depends on that block alone.
  constexpr int kLevels = 52;  // 0, 5, …, 255
  Pixels pixels(4 * kLevels, 2 * kLevels * kLevels);
  const auto colour = [](int column, int row) {
    return static_cast<std::uint32_t>(
        0xff000000u | static_cast<unsigned>(5 * (row / kLevels)) << 16 |
        static_cast<unsigned>(5 * (row % kLevels)) << 8 | static_cast<unsigned>(5 * column));
  };
  for (int y = 0; y < pixels.height_px; ++y) {
    for (int x = 0; x < pixels.width_px; ++x) pixels.at(x, y) = colour(x / 4, y / 2);
  }
  const Picture picture = converted(pixels);
  long double worst = 0;
  for (int row = 0; row < kLevels * kLevels; ++row) {
    for (int column = 0; column < kLevels; ++column) {
      worst = std::max(worst,
                       chroma_error(picture, 4 * column + 2, 2 * row, bt709(colour(column, row))));
    }
  }
  EXPECT_LE(worst, kTolerance);
}

TEST(Yuv420, GreysHaveNoColour) {
  for (std::uint32_t level = 0; level < 256; ++level) {
    Pixels pixels(2, 2);
    std::ranges::fill(pixels.words, 0xff000000 | level * 0x010101);
    const Picture picture = converted(pixels);
    EXPECT_EQ(picture.cb.at(0, 0), 128) << level;
    EXPECT_EQ(picture.cr.at(0, 0), 128) << level;
  }
  EXPECT_EQ(converted(Pixels(2, 2)).y.at(0, 0), 235);
}

TEST(Yuv420, ChromaIsSitedLeft) {
  for (const int width : {2, 4, 510, 512, 514, 1030}) {  // about the length of a strip
    const Pixels pixels = random_frame(width, 6, 17);
    const Picture picture = converted(pixels);
    long double worst = 0;
    for (int y = 0; y < pixels.height_px; y += 2) {
      for (int x = 0; x < width; x += 2) {
        std::array<long double, 3> mean = {0, 0, 0};  // blue, green, red
        for (const int dy : {0, 1}) {
          for (const int dx : {-1, 0, 1}) {
            const std::uint32_t pixel = pixels.at(std::max(0, x + dx), y + dy);
            const long double weight = dx == 0 ? 0.25L : 0.125L;
            for (unsigned i = 0; i < 3; ++i) mean[i] += weight * ((pixel >> (8 * i)) & 0xff);
          }
        }
        worst = std::max(worst,
                         chroma_error(picture, x, y, piblocks::bt709(mean[2], mean[1], mean[0])));
      }
    }
    EXPECT_LE(worst, kTolerance) << width;
  }
}

TEST(Yuv420, ARectangleIsConvertedAsInTheWholeFrame) {
  const Pixels pixels = random_frame(1200, 40, 3);
  const Picture whole = converted(pixels);
  for (const PixelRect rect : {PixelRect{0, 0, 2, 2}, PixelRect{2, 4, 600, 8},
                               PixelRect{510, 38, 690, 2}, PixelRect{1198, 0, 2, 40}}) {
    const Picture untouched(1200, 40, 2, 7);
    Picture part = untouched;
    convert_to_yuv420(pixels.view(), rect, part.view());
    for (int y = 0; y < pixels.height_px; ++y) {
      for (int x = 0; x < pixels.width_px; ++x) {
        const bool inside =
            x >= rect.x_px && x < rect.right_px() && y >= rect.y_px && y < rect.bottom_px();
        const Picture& expected = inside ? whole : untouched;
        ASSERT_EQ(part.y.at(x, y), expected.y.at(x, y)) << x << ' ' << y;
        ASSERT_EQ(part.cb.at(x / 2, y / 2), expected.cb.at(x / 2, y / 2)) << x << ' ' << y;
        ASSERT_EQ(part.cr.at(x / 2, y / 2), expected.cr.at(x / 2, y / 2)) << x << ' ' << y;
      }
    }
  }
}

TEST(Yuv420, VectorInstructionsChangeNoSample) {
  for (const int width : {2, 14, 16, 18, 30, 34, 62, 66, 126, 510, 512, 514, 1030, 1920}) {
    const Pixels pixels = random_frame(width, 20, static_cast<unsigned>(width));
    const Picture fast = converted(pixels);
    Picture slow(width, 20, 2);
    convert_to_yuv420_scalar(pixels.view(), {0, 0, width, 20}, slow.view());
    EXPECT_TRUE(fast == slow) << width;
  }
}

TEST(Yuv420, AChangeReachesNoSampleOutsideOfItsAlignedRectangle) {
  TracedRandom random(420);
  for (int i = 0; i < 300; ++i) {
    const int width = 2 * static_cast<int>(random.integer(1, 12));
    const int height = 2 * static_cast<int>(random.integer(1, 5));
    Pixels pixels = random_frame(width, height, static_cast<unsigned>(i));
    Picture picture = converted(pixels);
    const auto x = static_cast<int>(random.integer(0, width - 1));
    const auto y = static_cast<int>(random.integer(0, height - 1));
    const PixelRect changed{x, y, static_cast<int>(random.integer(1, width - x)),
                            static_cast<int>(random.integer(1, height - y))};
    for (int row = y; row < y + changed.height_px; ++row) {
      for (int column = x; column < x + changed.width_px; ++column) {
        pixels.words[static_cast<std::size_t>(row * width + column)] ^= 0x00ffffff;
      }
    }
    convert_to_yuv420(pixels.view(), chroma_aligned(changed, pixels.view()), picture.view());
    ASSERT_TRUE(picture == converted(pixels));
  }
}

TEST(Yuv420, TakesNoRectangleForNothing) {
  const Pixels pixels(4, 4);
  Picture picture(4, 4, 2, 7);
  convert_to_yuv420(pixels.view(), {2, 2, 0, 0}, picture.view());
  EXPECT_TRUE(picture == Picture(4, 4, 2, 7));
}

}  // namespace
}  // namespace piblocks
