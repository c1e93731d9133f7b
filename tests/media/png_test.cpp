#include <gtest/gtest.h>
#include <piblocks/png.hpp>

#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "media/png_encoder.hpp"
#include "support/decode_video.hpp"
#include "support/property.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
using testing_support::article_frame;
using testing_support::Pixels;
using testing_support::random_frame;
using testing_support::TemporaryFolder;

Pixels decoded(const std::vector<std::uint8_t>& png) {
  const TemporaryFolder folder;
  std::ofstream(folder / "image.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  return testing_support::decode_video(folder / "image.png").frames.at(0).rgb;
}

void expect_same_pixels(const Pixels& image) {
  const Pixels read_back = decoded(encode_png(image.view()));
  ASSERT_EQ(read_back.width_px, image.width_px);
  ASSERT_EQ(read_back.height_px, image.height_px);
  EXPECT_TRUE(read_back.words == image.words) << image.width_px << 'x' << image.height_px;
}

TEST(Png, KeepsEveryPixel) {
  expect_same_pixels(random_frame(1, 1, 1));
  expect_same_pixels(random_frame(1, 7, 2));
  expect_same_pixels(random_frame(250, 234, 3));
  expect_same_pixels(article_frame(1920, 1080, 1.5));
}

TEST(Png, ReadsRowsByTheirStride) {
  const Pixels whole = random_frame(40, 30, 4);
  Pixels part(10, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 10; ++x) part.at(x, y) = whole.at(x, y);
  }
  ImageView view = whole.view();
  view.width_px = 10;
  EXPECT_EQ(encode_png(view), encode_png(part.view()));
}

TEST(Png, SaysThatTheColoursAreSrgb) {
  const auto png = encode_png(Pixels(3, 2).view());
  const std::string bytes(png.begin(), png.end());
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
  EXPECT_LT(bytes.find("sRGB"), bytes.find("IDAT"));
}

std::vector<std::uint8_t> encoded(PngEncoder& encoder, const ImageView& image,
                                  const std::vector<PixelRect>& changed = {}) {
  encoder.filter(image, changed);
  return encoder.compress();
}

TEST(Png, DoesNotDependOnWhatWasEncodedBefore) {
  PngEncoder encoder;
  const Pixels image = article_frame(160, 90, 0);
  encoded(encoder, random_frame(300, 200, 5).view());
  EXPECT_EQ(encoded(encoder, image.view()), encode_png(image.view()));
}

/// Changes some pixels of a rectangle, or none.
PixelRect change(Random& random, Pixels& image) {
  const auto x = static_cast<int>(random.integer(0, image.width_px - 1));
  const auto y = static_cast<int>(random.integer(0, image.height_px - 1));
  const PixelRect rect{x, y, static_cast<int>(random.integer(1, image.width_px - x)),
                       static_cast<int>(random.integer(1, image.height_px - y))};
  const auto kind = random.integer(0, 2);
  if (kind == 0) return rect;
  const auto flat = static_cast<std::uint32_t>(random.integer(0, 0xffffff)) | 0xff000000;
  for (int row = y; row < y + rect.height_px; ++row) {
    for (int column = x; column < x + rect.width_px; ++column) {
      image.at(column, row) =
          kind == 1 ? flat : static_cast<std::uint32_t>(random.integer(0, 0xffffff)) | 0xff000000;
    }
  }
  return rect;
}

TEST(Png, AnUpdateGivesTheBytesOfTheImageAlone) {
  Random random(8);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 60; ++i) {
    Pixels image = random_frame(static_cast<int>(random.integer(1, 40)),
                                static_cast<int>(random.integer(1, 60)), static_cast<unsigned>(i));
    PngEncoder encoder;
    encoded(encoder, image.view());
    for (int step = 0; step < 10; ++step) {
      const std::vector<PixelRect> changed = {change(random, image), change(random, image)};
      ASSERT_EQ(encoded(encoder, image.view(), changed), encode_png(image.view())) << step;
    }
    expect_same_pixels(image);
  }
}

TEST(Png, IsWhatPngcheckAccepts) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {640, 363}}) {
    const auto png = encode_png(article_frame(width, height, 1.5).view());
    std::ofstream(folder / "image.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    const std::string command = "pngcheck -q '" + (folder / "image.png") + "'";
    if (std::system("command -v pngcheck > /dev/null") != 0) GTEST_SKIP() << "no pngcheck here";
    EXPECT_EQ(std::system(command.c_str()), 0);
  }
}

}  // namespace
}  // namespace piblocks
