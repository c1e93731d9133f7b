#include <gtest/gtest.h>
#include <piblocks/encode.hpp>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "media/output/output.hpp"
#include "media/png/png_reader.hpp"
#include "support/decode_video.hpp"
#include "support/temporary_folder.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::article_frame;
using testing_support::Pixels;
using testing_support::random_frame;
using testing_support::TemporaryFolder;
using testing_support::transparent_frame;
using testing_support::with_alpha;

/// A picture in a file.
std::string saved(const TemporaryFolder& folder, const ImageView& image) {
  const std::vector<std::uint8_t> png = encode_png(image);
  return folder.save("a.png", {reinterpret_cast<const char*>(png.data()), png.size()});
}

void expect_same_pixels(const Pixels& image) {
  const TemporaryFolder folder;
  const auto video = testing_support::decode_video(saved(folder, image.view()));
  const Pixels& read_back = video.frames.at(0).rgb;
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

/// A sequence of pictures like this one.
Output sequence_of(const ImageView& image) {
  return set_up_output("%d.png", {image.width_px, image.height_px, 25, image.has_alpha}, {});
}

/// The file of the next picture, of which all has changed unless something is said.
Bytes encoded(ChunkEncoder& encoder, const ImageView& image,
              const std::vector<PixelRect>& changed = {}) {
  encoder.begin(0);
  changed.empty() ? encoder.take(image) : encoder.take(image, changed);
  encoder.encode();
  return encoder.finish().front().bytes;
}

TEST(Png, DoesNotDependOnWhatWasEncodedBefore) {
  const Pixels image = article_frame(160, 90, 0);
  const Output sequence = sequence_of(image.view());
  const auto encoder = sequence.make_encoder();
  encoded(*encoder, random_frame(160, 90, 5).view());
  EXPECT_EQ(encoded(*encoder, image.view(), {{0, 0, 160, 90}}), encode_png(image.view()));
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
  TracedRandom random(8);
  for (int i = 0; i < 60; ++i) {
    Pixels image = random_frame(static_cast<int>(random.integer(1, 40)),
                                static_cast<int>(random.integer(1, 60)), static_cast<unsigned>(i));
    const Output sequence = sequence_of(image.view());
    const auto encoder = sequence.make_encoder();
    encoded(*encoder, image.view());
    for (int step = 0; step < 10; ++step) {
      const std::vector<PixelRect> changed = {change(random, image), change(random, image)};
      ASSERT_EQ(encoded(*encoder, image.view(), changed), encode_png(image.view())) << step;
    }
    expect_same_pixels(image);
  }
}

TEST(Png, KeepsAlphaAndTheColoursAsTheyWereBefore) {
  const TemporaryFolder folder;
  const Pixels image = transparent_frame(61, 47, 9);
  const Image read = read_png(saved(folder, with_alpha(image)));
  for (std::size_t i = 0; i < image.words.size(); ++i) {
    const std::uint32_t alpha = image.words[i] >> 24;
    ASSERT_EQ(read.words[i] >> 24, alpha);
    for (const int shift : {0, 8, 16}) {
      const double exact = alpha == 0 ? 0 : 255.0 * (image.words[i] >> shift & 0xff) / alpha;
      ASSERT_NEAR(read.words[i] >> shift & 0xff, exact, 0.5);
    }
  }
}

TEST(Png, AnUpdateWithAlphaGivesTheBytesOfTheImageAlone) {
  TracedRandom random(10);
  Pixels image = transparent_frame(33, 21, 10);
  const Output sequence = sequence_of(with_alpha(image));
  const auto encoder = sequence.make_encoder();
  ASSERT_EQ(encoded(*encoder, with_alpha(image)), encode_png(with_alpha(image)));
  for (std::uint32_t step = 0; step < 50; ++step) {
    const auto x = static_cast<int>(random.integer(0, 32));
    const auto y = static_cast<int>(random.integer(0, 20));
    image.at(x, y) = transparent_frame(1, 1, step).at(0, 0);
    ASSERT_EQ(encoded(*encoder, with_alpha(image), {{x, y, 1, 1}}), encode_png(with_alpha(image)));
  }
}

TEST(Png, IsWhatPngcheckAccepts) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {640, 363}}) {
    const std::string file = saved(folder, article_frame(width, height, 1.5).view());
    const std::string command = "pngcheck -q '" + file + "'";
    if (std::system("command -v pngcheck > /dev/null") != 0) GTEST_SKIP() << "no pngcheck here";
    EXPECT_EQ(std::system(command.c_str()), 0);
  }
}

}  // namespace
}  // namespace piblocks
