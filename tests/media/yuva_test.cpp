// The conversions of transparent pictures, against exact values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "media/pixels/rgb24.hpp"
#include "media/yuv_pictures.hpp"
#include "support/article_frames.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::Pixels;
using testing_support::transparent_frame;
using testing_support::with_alpha;

/// Half for rounding, and a little for the rounding of the expectation.
constexpr long double kHalf = 0.5L + 1e-9L;

/// Sums of colours that were multiplied by alpha, and of alphas.
struct Light {
  long double red = 0, green = 0, blue = 0, alpha = 0;

  void add(std::uint32_t word, long double weight) {
    red += weight * (word >> 16 & 0xff);
    green += weight * (word >> 8 & 0xff);
    blue += weight * (word & 0xff);
    alpha += weight * (word >> 24);
  }
};

/// Black if transparent.
ExactYuv exact_yuv(const Light& light, int bits) {
  return bt709(light.red, light.green, light.blue, light.alpha == 0 ? 1 : light.alpha, bits);
}

TEST(Unmultiplied, IsTheNearestForEveryColourAndAlpha) {
  for (std::uint32_t alpha = 1; alpha < 256; ++alpha) {
    for (std::uint32_t sample = 0; sample <= alpha; ++sample) {
      EXPECT_LE(std::abs(unmultiplied(sample, alpha) - 255.0L * sample / alpha), 0.5L);
    }
  }
  EXPECT_EQ(unmultiplied(0, 0), 0);
}

TEST(Yuva444p10, EverySampleIsTheNearest) {
  const Pixels pixels = transparent_frame(601, 403, 444);
  YuvPicture<std::uint16_t> picture(601, 403, 1);
  convert_to_yuva444p10(with_alpha(pixels), {0, 0, 601, 403}, picture.view());
  for (int y = 0; y < 403; ++y) {
    for (int x = 0; x < 601; ++x) {
      Light light;
      light.add(pixels.at(x, y), 1);
      const ExactYuv exact = exact_yuv(light, 10);
      ASSERT_LE(std::abs(picture.y.at(x, y) - exact.y), kHalf) << x << ' ' << y;
      ASSERT_LE(std::abs(picture.cb.at(x, y) - exact.cb), kHalf) << x << ' ' << y;
      ASSERT_LE(std::abs(picture.cr.at(x, y) - exact.cr), kHalf) << x << ' ' << y;
      ASSERT_LE(std::abs(picture.alpha.at(x, y) - light.alpha * 1023 / 255), kHalf);
    }
  }
}

TEST(Yuva444p10, OpaquePixelsNeedNoAlphaPlane) {
  Pixels pixels(3, 1);
  pixels.words = {0x00ffffff, 0x00000000, 0x00ff0000};  // any byte may stand for alpha
  YuvPicture<std::uint16_t> picture(3, 1, 1);
  convert_to_yuva444p10(pixels.view(), {0, 0, 3, 1},
                        {picture.y.view(), picture.cb.view(), picture.cr.view(), {}});
  EXPECT_EQ(picture.y.samples, (std::vector<std::uint16_t>{940, 64, 250}));
  EXPECT_EQ(picture.cr.samples, (std::vector<std::uint16_t>{512, 512, 960}));
}

TEST(Yuva420, EverySampleIsTheNearestAndChromaIsWeightedByAlpha) {
  const Pixels pixels = transparent_frame(402, 202, 420);
  YuvPicture<std::uint8_t> picture(402, 202, 2);
  convert_to_yuva420(with_alpha(pixels), {0, 0, 402, 202}, picture.view());
  for (int y = 0; y < 202; ++y) {
    for (int x = 0; x < 402; ++x) {
      Light light;
      light.add(pixels.at(x, y), 1);
      ASSERT_LE(std::abs(picture.y.at(x, y) - exact_yuv(light, 8).y), kHalf) << x << ' ' << y;
      ASSERT_EQ(picture.alpha.at(x, y), pixels.at(x, y) >> 24);
      if (x % 2 != 0 || y % 2 != 0) continue;
      Light around;
      for (const int dy : {0, 1}) {
        for (const int dx : {-1, 0, 1}) {
          around.add(pixels.at(std::max(0, x + dx), y + dy), dx == 0 ? 2 : 1);
        }
      }
      const ExactYuv exact = exact_yuv(around, 8);
      ASSERT_LE(std::abs(picture.cb.at(x / 2, y / 2) - exact.cb), kHalf) << x << ' ' << y;
      ASSERT_LE(std::abs(picture.cr.at(x / 2, y / 2) - exact.cr), kHalf) << x << ' ' << y;
    }
  }
}

TEST(Yuva420, AnEdgeKeepsItsColour) {
  // Red at the left, transparent at the right: all chroma samples with any red in them are red's.
  Pixels pixels(8, 2);
  for (int i = 0; i < 16; ++i) pixels.words[std::size_t(i)] = i % 8 < 4 ? 0xffd63028 : 0;
  YuvPicture<std::uint8_t> picture(8, 2, 2);
  convert_to_yuva420(with_alpha(pixels), {0, 0, 8, 2}, picture.view());
  for (const int x : {0, 1, 2}) {
    EXPECT_EQ(picture.cb.at(x, 0), picture.cb.at(0, 0));
    EXPECT_EQ(picture.cr.at(x, 0), picture.cr.at(0, 0));
  }
  EXPECT_EQ(picture.cr.at(3, 0), 128);
}

TEST(Yuva420, AChangeReachesNoSampleOutsideOfItsAlignedRectangle) {
  TracedRandom random(42);
  for (std::uint32_t i = 0; i < 200; ++i) {
    Pixels pixels = transparent_frame(12, 8, i);
    const auto convert = [&](const PixelRect& rect, YuvPicture<std::uint8_t>& to) {
      convert_to_yuva420(with_alpha(pixels), rect, to.view());
    };
    YuvPicture<std::uint8_t> picture(12, 8, 2);
    convert({0, 0, 12, 8}, picture);
    const auto x = static_cast<int>(random.integer(0, 11));
    const auto y = static_cast<int>(random.integer(0, 7));
    pixels.at(x, y) = 0xff000000 | static_cast<std::uint32_t>(random.integer(0, 0xffffff));
    convert(chroma_aligned({x, y, 1, 1}, with_alpha(pixels)), picture);
    YuvPicture<std::uint8_t> whole(12, 8, 2);
    convert({0, 0, 12, 8}, whole);
    ASSERT_TRUE(picture == whole);
  }
}

}  // namespace
}  // namespace piblocks
