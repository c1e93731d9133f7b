// PNG files of every depth and colour type, read as they are stored.
#include "media/png/png_reader.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <string>
#include <vector>

#include "media/png/png_chunk.hpp"
#include "support/hand_made_png.hpp"
#include "support/temporary_folder.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::big_endian;
using testing_support::channels_of;
using testing_support::file_of;
using testing_support::HandMadePng;
using testing_support::png_chunk;
using testing_support::PngColour;
using testing_support::TemporaryFolder;

/// By libpng.
AnyImage read_samples(const std::string& path) {
  const auto frame = read_png_frame(path);
  frame->next();
  return frame->samples();
}

class PngReaderTest : public testing::Test {
 protected:
  std::string saved(const std::string& bytes) const { return folder_.save("a.png", bytes); }
  AnyImage samples_of(const HandMadePng& png) const { return read_samples(saved(file_of(png))); }

  TemporaryFolder folder_;
};

struct Kind {
  PngColour colour;
  int bits;
};

constexpr Kind kKinds[] = {
    {PngColour::grey, 1},        {PngColour::grey, 2},    {PngColour::grey, 4},
    {PngColour::grey, 8},        {PngColour::grey, 16},   {PngColour::rgb, 8},
    {PngColour::rgb, 16},        {PngColour::palette, 1}, {PngColour::palette, 2},
    {PngColour::palette, 4},     {PngColour::palette, 8}, {PngColour::grey_alpha, 8},
    {PngColour::grey_alpha, 16}, {PngColour::rgba, 8},    {PngColour::rgba, 16}};

HandMadePng random_png(Random& random, const Kind& kind) {
  HandMadePng png{.width_px = static_cast<int>(random.integer(1, 20)),
                  .height_px = static_cast<int>(random.integer(1, 20)),
                  .bits = kind.bits,
                  .colour = kind.colour};
  for (int i = png.width_px * png.height_px * channels_of(kind.colour); i > 0; --i) {
    png.levels.push_back(static_cast<int>(random.integer(0, (1 << kind.bits) - 1)));
  }
  png.is_interlaced = random.integer(0, 1) == 1;
  return png;
}

/// Red, green, blue and alpha of a pixel, at the depth that is read.
std::vector<std::uint64_t> pixel_of(const HandMadePng& png, std::size_t pixel,
                                    const std::vector<std::uint32_t>& palette) {
  const auto channels = static_cast<std::size_t>(channels_of(png.colour));
  const auto level = [&](std::size_t channel) {
    const auto stored = static_cast<std::uint64_t>(png.levels.at(pixel * channels + channel));
    return png.bits < 8 ? stored * 255 / ((1U << png.bits) - 1) : stored;
  };
  const std::uint64_t opaque = png.bits == 16 ? 65535 : 255;
  switch (png.colour) {
    case PngColour::grey:
      return {level(0), level(0), level(0), opaque};
    case PngColour::grey_alpha:
      return {level(0), level(0), level(0), level(1)};
    case PngColour::rgb:
      return {level(0), level(1), level(2), opaque};
    case PngColour::rgba:
      return {level(0), level(1), level(2), level(3)};
    case PngColour::palette:
      break;
  }
  const std::uint32_t word = palette.at(static_cast<std::size_t>(png.levels.at(pixel)));
  return {word >> 16 & 0xff, word >> 8 & 0xff, word & 0xff, word >> 24};
}

/// A palette of random words 0xAARRGGBB, and its chunks.
std::vector<std::uint32_t> add_palette(Random& random, HandMadePng& png) {
  std::vector<std::uint32_t> palette;
  std::string colours;
  std::string alphas;
  for (int i = 0; i < 1 << png.bits; ++i) {
    const auto word = static_cast<std::uint32_t>(random.integer(0, 0xffffffff));
    palette.push_back(word);
    colours += big_endian(word).substr(1);
    alphas += big_endian(word)[0];
  }
  png.chunks = png_chunk("PLTE", colours) + png_chunk("tRNS", alphas);
  return palette;
}

TEST_F(PngReaderTest, KeepsEverySampleOfEveryKind) {
  TracedRandom random(31);
  for (const Kind& kind : kKinds) {
    for (int i = 0; i < 12; ++i) {
      HandMadePng png = random_png(random, kind);
      std::vector<std::uint32_t> palette;
      if (kind.colour == PngColour::palette) palette = add_palette(random, png);
      const AnyImage samples = samples_of(png);
      ASSERT_EQ(max_level_of(samples), kind.bits == 16 ? 65535 : 255);
      for (std::size_t pixel = 0; pixel < png.levels.size() / std::size_t(channels_of(kind.colour));
           ++pixel) {
        const auto expected = pixel_of(png, pixel, palette);
        const auto word_of = [&](int bits) {
          return expected[3] << 3 * bits | expected[0] << 2 * bits | expected[1] << bits |
                 expected[2];
        };
        if (kind.bits == 16) {
          ASSERT_EQ(std::get<DeepImage>(samples).words.at(pixel), word_of(16));
        } else {
          ASSERT_EQ(std::get<Image>(samples).words.at(pixel), word_of(8));
        }
      }
    }
  }
}

TEST_F(PngReaderTest, AppliesNoGammaToWhatIsStored) {
  HandMadePng png{.width_px = 4, .bits = 16, .colour = PngColour::grey};
  png.levels = {0, 0x1234, 0x8001, 0xffff};
  for (const std::uint32_t gamma : {0U, 45455U, 100000U}) {
    png.chunks = gamma == 0 ? "" : png_chunk("gAMA", big_endian(gamma));
    const auto words = std::get<DeepImage>(samples_of(png)).words;
    EXPECT_EQ(words, (std::vector<std::uint64_t>{0xffff000000000000, 0xffff123412341234,
                                                 0xffff800180018001, 0xffffffffffffffff}));
  }
}

TEST_F(PngReaderTest, SixteenBitsAreRoundedToEight) {
  HandMadePng png{.width_px = 256, .bits = 16, .colour = PngColour::grey};
  for (int level = 0; level < 256; ++level) png.levels.push_back(257 * level);
  const Image image = read_png(saved(file_of(png)));
  for (std::uint32_t level = 0; level < 256; ++level) {
    ASSERT_EQ(image.words.at(level), 0xff000000U | level * 0x010101U);
  }
}

TEST_F(PngReaderTest, AColourCanBeTransparentAtAnyDepth) {
  HandMadePng png{.width_px = 2, .bits = 16, .colour = PngColour::rgb};
  png.levels = {1, 2, 3, 1, 2, 4};
  png.chunks = png_chunk("tRNS", std::string("\0\1\0\2\0\3", 6));
  EXPECT_EQ(std::get<DeepImage>(samples_of(png)).words,
            (std::vector<std::uint64_t>{0x0000000100020003, 0xffff000100020004}));
  HandMadePng grey{.width_px = 2, .bits = 2, .colour = PngColour::grey};
  grey.levels = {1, 2};
  grey.chunks = png_chunk("tRNS", std::string("\0\2", 2));
  EXPECT_EQ(std::get<Image>(samples_of(grey)).words,
            (std::vector<std::uint32_t>{0xff555555, 0x00aaaaaa}));
}

TEST_F(PngReaderTest, RefusesWhatIsDamagedAnywhere) {
  TracedRandom random(32);
  const std::string whole = file_of(random_png(random, {PngColour::rgba, 16}));
  EXPECT_NO_THROW(read_samples(saved(whole)));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_THROW(read_samples(saved(whole.substr(0, i))), MediaError) << i;
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    EXPECT_THROW(read_samples(saved(damaged)), MediaError) << i;
  }
}

// As libpng, browsers and image viewers do.
TEST_F(PngReaderTest, TakesDamageThatPixelsDoNotDependOn) {
  const auto broken = [](const std::string& type, const std::string& data) {
    std::string chunk = png_chunk(type, data);
    chunk.back() = static_cast<char>(chunk.back() ^ 1);
    return chunk;
  };
  HandMadePng png{.width_px = 2, .levels = {1, 2, 3, 4, 5, 6}};
  const auto words = std::get<Image>(samples_of(png)).words;
  for (const char* const type : {"gAMA", "tEXt", "pHYs", "sRGB", "iCCP", "tIME", "eXIf", "abCd"}) {
    png.chunks = broken(type, "some bytes of data");
    EXPECT_EQ(std::get<Image>(samples_of(png)).words, words) << type;
  }
  png.chunks.clear();
  const AnyImage with_tail = read_samples(saved(file_of(png) + "trailing data"));
  EXPECT_EQ(std::get<Image>(with_tail).words, words);
  for (const char* const type : {"tRNS", "acTL", "PLTE", "IDAT", "ABCD"}) {
    png.chunks = broken(type, std::string("\0\1\0\2\0\3", 6));
    EXPECT_THROW(samples_of(png), MediaError) << type;
  }
  png.chunks = png_chunk("tRNS", std::string("\0\1\0\2\0\3\0", 7));  // too long
  EXPECT_THROW(samples_of(png), MediaError);
}

TEST_F(PngReaderTest, RefusesAColourThatIsNotInThePalette) {
  for (const int bits : {1, 2, 4, 8}) {
    HandMadePng png{.width_px = 3, .bits = bits, .colour = PngColour::palette};
    const int count = bits == 8 ? 200 : (1 << bits) - 1;
    png.chunks = png_chunk("PLTE", std::string(std::size_t(3 * count), 'x'));
    for (const bool is_interlaced : {false, true}) {
      png.is_interlaced = is_interlaced;
      png.levels = {0, count - 1, count - 1};
      EXPECT_NO_THROW(samples_of(png)) << bits;
      png.levels = {0, count, 0};
      EXPECT_THROW(samples_of(png), MediaError) << bits;
    }
  }
}

/// The leak checker sees whether libpng's objects go when the reader is not completed.
TEST_F(PngReaderTest, RefusesWhatIsTooLarge) {
  const std::string header = big_endian(16385) + big_endian(1) + std::string("\x08\x02\0\0\0", 5);
  const std::string path =
      saved("\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", "x"));
  EXPECT_THROW(read_png(path), MediaError);
  EXPECT_THROW(read_samples(path), MediaError);
}

TEST_F(PngReaderTest, TellsAnAnimationFromAPicture) {
  HandMadePng png{.levels = {1, 2, 3}};
  EXPECT_FALSE(is_animated_png(saved(file_of(png))));
  // Of one frame, if that is not the picture that other programs show.
  png.chunks = png_chunk("acTL", big_endian(1) + big_endian(0));
  EXPECT_TRUE(is_animated_png(saved(file_of(png))));
  png.chunks += png_chunk("fcTL", std::string(26, '\0'));
  EXPECT_FALSE(is_animated_png(saved(file_of(png))));
  png.chunks = png_chunk("acTL", big_endian(2) + big_endian(0));
  EXPECT_TRUE(is_animated_png(saved(file_of(png))));
  EXPECT_THROW(samples_of(png), MediaError);
}

/// Exif with one tag, Orientation.
std::string exif(int orientation, bool is_big) {
  const auto number = [&](unsigned value, int size) {
    std::string bytes;
    for (int i = 0; i < size; ++i)
      bytes += static_cast<char>(value >> 8 * (is_big ? size - 1 - i : i));
    return bytes;
  };
  return (is_big ? "MM" : "II") + number(42, 2) + number(8, 4) + number(1, 2) + number(0x112, 2) +
         number(3, 2) + number(1, 4) + number(unsigned(orientation), 2) + number(0, 2) +
         number(0, 4);
}

TEST_F(PngReaderTest, ReadsDeepSamplesThatAreEncoded) {
  DeepImage image{.width_px = 5, .height_px = 3};
  for (std::uint64_t i = 0; i < 15; ++i) image.words.push_back(0x0123456789abcdef * (i + 1));
  const auto reader = read_png_bytes("memory", encode_png_samples(image));
  ASSERT_TRUE(reader->next());
  EXPECT_EQ(std::get<DeepImage>(reader->samples()).words, image.words);
  EXPECT_FALSE(reader->next());
}

TEST_F(PngReaderTest, SaysHowPlayersTurnThePicture) {
  const auto presentation_of = [&](const std::string& data) {
    HandMadePng png{.levels = {1, 2, 3}};
    png.chunks = png_chunk("eXIf", data);
    const std::string file = file_of(png);
    const auto reader = read_png_frame(saved(file));
    const auto in_memory = read_png_bytes("memory", Bytes(file.begin(), file.end()));
    EXPECT_TRUE(reader->next() && in_memory->next());
    EXPECT_EQ(in_memory->presentation(), reader->presentation());
    return reader->presentation();
  };
  for (const bool is_big : {true, false}) {
    EXPECT_EQ(presentation_of(exif(1, is_big)), "");
    EXPECT_EQ(presentation_of(exif(3, is_big)), "turned clockwise by 180 degrees");
    EXPECT_EQ(presentation_of(exif(5, is_big)), "mirrored and turned clockwise by 90 degrees");
    EXPECT_EQ(presentation_of(exif(6, is_big)), "turned clockwise by 90 degrees");
    for (const int unknown : {0, 9, 65535}) EXPECT_EQ(presentation_of(exif(unknown, is_big)), "");
    const std::string whole = exif(6, is_big);
    for (std::size_t size = 4; size + 6 < whole.size(); ++size) {
      EXPECT_EQ(presentation_of(whole.substr(0, size)), "") << size;
    }
  }
  EXPECT_EQ(presentation_of("MM" + std::string("\0\x2a\xff\xff\xff\xff", 6)), "");
}

TEST(AnyImage, IsBroughtToADepthThatKeepsLevelsApart) {
  Image image{256, 1, {}};
  for (std::uint32_t level = 0; level < 256; ++level) image.words.push_back(level * 0x01010101U);
  const DeepImage deep = deepened(image, 65535);
  for (std::uint64_t level = 0; level < 256; ++level) {
    EXPECT_EQ(deep.words.at(level), level * 257 * 0x0001000100010001U);
  }
  EXPECT_EQ(flattened(deep).words, image.words);
  DeepImage ten{1024, 1, 1023, {}};
  for (std::uint64_t level = 0; level < 1024; ++level) ten.words.push_back(level);
  const DeepImage sixteen = deepened(ten, 65535);
  for (std::size_t i = 1; i < 1024; ++i) EXPECT_LT(sixteen.words.at(i - 1), sixteen.words.at(i));
  EXPECT_EQ(sixteen.words.back(), 65535U);
}

}  // namespace
}  // namespace piblocks
