// The conversions of transparent pictures, against exact values.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "media/pixels/rgb24.hpp"
#include "media/pixels/yuv.hpp"
#include "support/article_frames.hpp"
#include "support/property.hpp"

namespace piblocks {
namespace {
using testing_support::Pixels;

/// Half for rounding, and a little for the rounding of the expectation.
constexpr long double kHalf = 0.5L + 1e-9L;

/// No colour is greater than its alpha.
Pixels random_pixels(Random& random, int width_px, int height_px) {
  Pixels pixels(width_px, height_px);
  for (std::uint32_t& word : pixels.words) {
    const std::array<std::int64_t, 4> alphas = {0, 255, random.integer(1, 9),
                                                random.integer(0, 255)};
    const std::int64_t alpha = alphas[static_cast<std::size_t>(random.integer(0, 3))];
    word = static_cast<std::uint32_t>(alpha << 24 | random.integer(0, alpha) << 16 |
                                      random.integer(0, alpha) << 8 | random.integer(0, alpha));
  }
  return pixels;
}

ImageView view_of(const Pixels& pixels) {
  ImageView view = pixels.view();
  view.has_alpha = true;
  return view;
}

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

struct Exact {
  long double y, cb, cr;
};

/// ITU-R BT.709-6, 3.2 to 3.4, in limited range of so many bits; black if transparent.
Exact bt709(const Light& light, int bits) {
  const long double one = std::exp2(static_cast<long double>(bits - 8));
  if (light.alpha == 0) return {16 * one, 128 * one, 128 * one};
  const long double red = light.red / light.alpha;
  const long double green = light.green / light.alpha;
  const long double blue = light.blue / light.alpha;
  const long double luma = 0.2126L * red + 0.7152L * green + 0.0722L * blue;
  return {one * (16 + 219 * luma), one * (128 + 224 * (blue - luma) / 1.8556L),
          one * (128 + 224 * (red - luma) / 1.5748L)};
}

template <typename Sample>
struct Plane {
  Plane(int width, int height, Sample filling = 0)
      : width_px(width), samples(std::size_t(width) * std::size_t(height), filling) {}
  Sample at(int x, int y) const { return samples[std::size_t(y * width_px + x)]; }
  PlaneView<Sample> view() {
    return {samples.data(), width_px * static_cast<std::ptrdiff_t>(sizeof(Sample))};
  }

  int width_px;
  std::vector<Sample> samples;
};

template <typename Sample>
struct Picture {
  Picture(int width, int height, int chroma, Sample filling = 0)
      : y(width, height, filling),
        cb(width / chroma, height / chroma, filling),
        cr(width / chroma, height / chroma, filling),
        alpha(width, height, filling) {}
  YuvView<Sample> view() { return {y.view(), cb.view(), cr.view(), alpha.view()}; }

  Plane<Sample> y, cb, cr, alpha;
};

TEST(Unmultiplied, IsTheNearestForEveryColourAndAlpha) {
  for (std::uint32_t alpha = 1; alpha < 256; ++alpha) {
    for (std::uint32_t sample = 0; sample <= alpha; ++sample) {
      EXPECT_LE(std::abs(unmultiplied(sample, alpha) - 255.0L * sample / alpha), 0.5L);
    }
  }
  EXPECT_EQ(unmultiplied(0, 0), 0);
}

TEST(Yuva444p10, EverySampleIsTheNearest) {
  Random random(444);
  SCOPED_TRACE(random.trace());
  const Pixels pixels = random_pixels(random, 601, 403);
  Picture<std::uint16_t> picture(601, 403, 1);
  convert_to_yuva444p10(view_of(pixels), {0, 0, 601, 403}, picture.view());
  for (int y = 0; y < 403; ++y) {
    for (int x = 0; x < 601; ++x) {
      Light light;
      light.add(pixels.at(x, y), 1);
      const Exact exact = bt709(light, 10);
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
  Picture<std::uint16_t> picture(3, 1, 1);
  convert_to_yuva444p10(pixels.view(), {0, 0, 3, 1},
                        {picture.y.view(), picture.cb.view(), picture.cr.view(), {}});
  EXPECT_EQ(picture.y.samples, (std::vector<std::uint16_t>{940, 64, 250}));
  EXPECT_EQ(picture.cr.samples, (std::vector<std::uint16_t>{512, 512, 960}));
}

TEST(Yuva420, EverySampleIsTheNearestAndChromaIsWeightedByAlpha) {
  Random random(420);
  SCOPED_TRACE(random.trace());
  const Pixels pixels = random_pixels(random, 402, 202);
  Picture<std::uint8_t> picture(402, 202, 2);
  convert_to_yuva420(view_of(pixels), {0, 0, 402, 202}, picture.view());
  for (int y = 0; y < 202; ++y) {
    for (int x = 0; x < 402; ++x) {
      Light light;
      light.add(pixels.at(x, y), 1);
      ASSERT_LE(std::abs(picture.y.at(x, y) - bt709(light, 8).y), kHalf) << x << ' ' << y;
      ASSERT_EQ(picture.alpha.at(x, y), pixels.at(x, y) >> 24);
      if (x % 2 != 0 || y % 2 != 0) continue;
      Light around;
      for (const int dy : {0, 1}) {
        for (const int dx : {-1, 0, 1}) {
          around.add(pixels.at(std::max(0, x + dx), y + dy), dx == 0 ? 2 : 1);
        }
      }
      const Exact exact = bt709(around, 8);
      ASSERT_LE(std::abs(picture.cb.at(x / 2, y / 2) - exact.cb), kHalf) << x << ' ' << y;
      ASSERT_LE(std::abs(picture.cr.at(x / 2, y / 2) - exact.cr), kHalf) << x << ' ' << y;
    }
  }
}

TEST(Yuva420, AnEdgeKeepsItsColour) {
  // Red at the left, transparent at the right: all chroma samples with any red in them are red's.
  Pixels pixels(8, 2);
  for (int i = 0; i < 16; ++i) pixels.words[std::size_t(i)] = i % 8 < 4 ? 0xffd63028 : 0;
  Picture<std::uint8_t> picture(8, 2, 2);
  convert_to_yuva420(view_of(pixels), {0, 0, 8, 2}, picture.view());
  for (const int x : {0, 1, 2}) {
    EXPECT_EQ(picture.cb.at(x, 0), picture.cb.at(0, 0));
    EXPECT_EQ(picture.cr.at(x, 0), picture.cr.at(0, 0));
  }
  EXPECT_EQ(picture.cr.at(3, 0), 128);
}

TEST(Yuva420, AChangeReachesNoSampleOutsideOfItsAlignedRectangle) {
  Random random(42);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    Pixels pixels = random_pixels(random, 12, 8);
    const auto convert = [&](const PixelRect& rect, Picture<std::uint8_t>& to) {
      convert_to_yuva420(view_of(pixels), rect, to.view());
    };
    Picture<std::uint8_t> picture(12, 8, 2);
    convert({0, 0, 12, 8}, picture);
    const auto x = static_cast<int>(random.integer(0, 11));
    const auto y = static_cast<int>(random.integer(0, 7));
    pixels.at(x, y) = 0xff000000 | static_cast<std::uint32_t>(random.integer(0, 0xffffff));
    convert(chroma_aligned({x, y, 1, 1}, view_of(pixels)), picture);
    Picture<std::uint8_t> whole(12, 8, 2);
    convert({0, 0, 12, 8}, whole);
    ASSERT_EQ(picture.y.samples, whole.y.samples);
    ASSERT_EQ(picture.cb.samples, whole.cb.samples);
    ASSERT_EQ(picture.cr.samples, whole.cr.samples);
    ASSERT_EQ(picture.alpha.samples, whole.alpha.samples);
  }
}

}  // namespace
}  // namespace piblocks
