#include <gtest/gtest.h>
#include <piblocks/png.hpp>

#include <fstream>

#include "media/png_encoder.hpp"
#include "support/decode_video.hpp"
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

TEST(Png, DoesNotDependOnWhatWasEncodedBefore) {
  PngEncoder encoder;
  const Pixels image = article_frame(160, 90, 0);
  encoder.encode(random_frame(300, 200, 5).view());
  EXPECT_EQ(encoder.encode(image.view()), encode_png(image.view()));
}

}  // namespace
}  // namespace piblocks
