// GIF files that no encoder of ours writes, against what browsers show of them.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <string>
#include <vector>

#include "media/libav/av_module.hpp"
#include "support/temporary_folder.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::TemporaryFolder;

using Words = std::vector<std::uint32_t>;

constexpr int kSide = 5;
constexpr int kTransparent = 7;
/// The colour table of all: index 0 is the background, which is never to be seen.
constexpr std::uint32_t colour(int index) { return 0xff101010U + std::uint32_t(index) * 0x11; }

struct MadeImage {
  int x = 0;
  int y = 0;
  int width = kSide;
  int height = kSide;
  int disposal = 0;
  bool is_interlaced = false;
  std::vector<int> indices = {};  ///< row by row
};

std::string little_endian(int value) {
  return {static_cast<char>(value & 0xff), static_cast<char>(value >> 8 & 0xff)};
}

/// LZW that clears its table before every code, so that each code is an index of 4 bits.
std::string data_of(const std::vector<int>& indices) {
  constexpr int kClear = 8;
  std::vector<int> codes;
  for (const int index : indices) codes.insert(codes.end(), {kClear, index});
  codes.push_back(kClear + 1);
  if (codes.size() % 2 != 0) codes.push_back(0);
  std::string bytes = "\3";
  for (std::size_t i = 0; i < codes.size(); i += 2) {
    if (i % 200 == 0)
      bytes += static_cast<char>(std::min<std::size_t>(100, (codes.size() - i) / 2));
    bytes += static_cast<char>(codes[i] | codes[i + 1] << 4);
  }
  return bytes + '\0';
}

std::vector<int> stored_rows(const MadeImage& image) {
  if (!image.is_interlaced) return image.indices;
  std::vector<int> stored;
  for (const auto& [first, step] : {std::pair(0, 8), {4, 8}, {2, 4}, {1, 2}}) {
    for (int y = first; y < image.height; y += step) {
      const auto row = image.indices.begin() + y * image.width;
      stored.insert(stored.end(), row, row + image.width);
    }
  }
  return stored;
}

std::string gif_of(const std::vector<MadeImage>& images) {
  std::string bytes =
      "GIF89a" + little_endian(kSide) + little_endian(kSide) + '\x82' + std::string("\0\0", 2);
  for (int i = 0; i < 8; ++i) {
    for (int shift = 16; shift >= 0; shift -= 8) bytes += static_cast<char>(colour(i) >> shift);
  }
  for (const MadeImage& image : images) {
    bytes += std::string("\x21\xf9\4") + static_cast<char>(image.disposal << 2 | 1) +
             little_endian(10) + static_cast<char>(kTransparent) + '\0';
    bytes += ',' + little_endian(image.x) + little_endian(image.y) + little_endian(image.width) +
             little_endian(image.height) + (image.is_interlaced ? '\x40' : '\0');
    bytes += data_of(stored_rows(image));
  }
  return bytes + ';';
}

/// Screens after each image, drawn pixel by pixel.
std::vector<Words> shown_of(const std::vector<MadeImage>& images) {
  std::vector<Words> shown;
  Words screen(kSide * kSide, 0);
  for (const MadeImage& image : images) {
    const Words before = screen;
    const auto for_each_pixel = [&](const auto& use) {
      for (int i = 0; i < image.width * image.height; ++i) {
        const int x = image.x + i % image.width;
        const int y = image.y + i / image.width;
        if (x < kSide && y < kSide)
          use(screen.at(std::size_t(y * kSide + x)), image.indices.at(std::size_t(i)));
      }
    };
    for_each_pixel([](std::uint32_t& word, int index) {
      if (index != kTransparent) word = colour(index);
    });
    shown.push_back(screen);
    if (image.disposal == 2) for_each_pixel([](std::uint32_t& word, int) { word = 0; });
    if (image.disposal == 3) screen = before;
  }
  return shown;
}

class GifReaderTest : public testing::Test {
 protected:
  std::vector<Words> frames_of(const std::string& bytes) const {
    std::vector<Words> frames;
    const auto reader = read_video(folder_.save("a.gif", bytes));
    while (reader->next()) frames.push_back(std::get<Image>(reader->samples()).words);
    return frames;
  }
  TemporaryFolder folder_;
};

MadeImage random_image(Random& random, bool is_whole) {
  MadeImage image;
  if (!is_whole) {
    image.x = static_cast<int>(random.integer(0, kSide + 2));  // perhaps beyond the screen
    image.y = static_cast<int>(random.integer(0, kSide + 2));
    image.width = static_cast<int>(random.integer(1, kSide));
    image.height = static_cast<int>(random.integer(1, kSide));
  }
  image.disposal = static_cast<int>(random.integer(0, 3));
  image.is_interlaced = random.integer(0, 1) == 1;
  for (int i = image.width * image.height; i > 0; --i) {
    image.indices.push_back(static_cast<int>(random.integer(1, kTransparent)));
  }
  return image;
}

TEST_F(GifReaderTest, ShowsWhatBrowsersShow) {
  TracedRandom random(81);
  for (std::int64_t run = 0; run < many(100); ++run) {
    std::vector<MadeImage> images;
    for (int i = 0; i < 6; ++i) images.push_back(random_image(random, i == 0 && run % 2 == 0));
    ASSERT_EQ(frames_of(gif_of(images)), shown_of(images)) << run;
  }
}

TEST_F(GifReaderTest, RefusesWhatIsCutOffAnywhere) {
  Random random(82);
  const std::string whole = gif_of({random_image(random, true), random_image(random, false)});
  EXPECT_EQ(frames_of(whole).size(), 2U);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(frames_of(whole.substr(0, size)), MediaError) << size;
  }
  EXPECT_EQ(frames_of(whole + "more").size(), 2U);
}

}  // namespace
}  // namespace piblocks
