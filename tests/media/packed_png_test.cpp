// PNG files read as they are packed, held to what libpng reads of them.
#include "media/png/packed_png.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "media/png/png_reader.hpp"
#include "support/hand_made_png.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::big_endian;
using testing_support::channels_of;
using testing_support::file_of;
using testing_support::HandMadePng;
using testing_support::png_chunk;
using testing_support::PngColour;

Bytes bytes_of(const std::string& file) { return {file.begin(), file.end()}; }

std::vector<std::uint32_t> words_by_libpng(const std::string& file) {
  return std::get<Image>(read_png_samples("a.png", bytes_of(file))).words;
}

HandMadePng random_png(Random& random) {
  constexpr std::array kColours = {PngColour::grey, PngColour::rgb, PngColour::palette,
                                   PngColour::grey_alpha, PngColour::rgba};
  HandMadePng png{.width_px = int(random.integer(1, 40)),
                  .height_px = int(random.integer(1, 12)),
                  .colour = kColours.at(std::size_t(random.integer(0, 4)))};
  // Few levels, so that rows can be compressed and neighbours are equal.
  const std::int64_t levels = random.integer(0, 1) == 0 ? 3 : 255;
  for (int i = png.width_px * png.height_px * channels_of(png.colour); i > 0; --i) {
    png.levels.push_back(int(random.integer(0, levels)));
  }
  for (int i = 0; i < 5; ++i) png.filters.push_back(int(random.integer(0, 4)));
  if (png.colour != PngColour::palette) return png;
  std::string colours;
  for (int i = 0; i < 256 * 3; ++i) colours += char(random.integer(0, 255));
  png.chunks = png_chunk("PLTE", colours);
  if (random.integer(0, 1) == 1) png.chunks += png_chunk("tRNS", colours.substr(0, 100));
  return png;
}

TEST(PackedPng, HasThePixelsThatLibpngReads) {
  TracedRandom random(41);
  for (int i = 0; i < 500; ++i) {
    const std::string file = file_of(random_png(random));
    const auto packed = read_packed_png(bytes_of(file));
    ASSERT_TRUE(packed);
    EXPECT_EQ(unpacked(*packed).words, words_by_libpng(file));
    EXPECT_TRUE(is_whole_png(bytes_of(file)));
  }
}

/// The file with its pixels in several chunks, a few bytes each.
std::string with_pieces(const std::string& file, std::size_t piece) {
  const std::size_t at = file.find("IDAT") - 4;
  const auto length = std::size_t(std::uint8_t(file[at + 2]) << 8 | std::uint8_t(file[at + 3]));
  std::string pieces;
  for (std::size_t i = 0; i < length; i += piece) {
    pieces += png_chunk("IDAT", file.substr(at + 8 + i, std::min(piece, length - i)));
  }
  return file.substr(0, at) + pieces + file.substr(at + 12 + length);
}

TEST(PackedPng, MayHaveItsPixelsInAnyPieces) {
  TracedRandom random(42);
  for (const std::size_t piece : {1U, 2U, 7U, 100U}) {
    const std::string file = with_pieces(file_of(random_png(random)), piece);
    const auto packed = read_packed_png(bytes_of(file));
    ASSERT_TRUE(packed);
    EXPECT_EQ(unpacked(*packed).words, words_by_libpng(file));
  }
}

/// Whatever is read at all is what libpng reads; damage is left to libpng, which names it.
TEST(PackedPng, ReadsNothingThatLibpngReadsInAnotherWay) {
  TracedRandom random(43);
  int read = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string file = file_of(random_png(random));
    for (std::int64_t left = random.integer(0, 2); left >= 0; --left) {
      const auto at = std::size_t(random.integer(0, std::int64_t(file.size()) - 1));
      const std::int64_t kind = random.integer(0, 3);
      if (kind == 0) file[at] = char(random.integer(0, 255));
      if (kind == 1) file = file.substr(0, at + 1);
      if (kind == 2) file.insert(at, file.substr(at / 2, 5));
      if (kind == 3 && file.size() > 33)
        file.insert(33, png_chunk(i % 2 == 0 ? "teSt" : "IDAT", file.substr(0, at % 40)));
    }
    const auto packed = read_packed_png(bytes_of(file));
    EXPECT_EQ(is_whole_png(bytes_of(file)), packed.has_value());
    if (!packed) continue;
    ++read;
    EXPECT_EQ(unpacked(*packed).words, words_by_libpng(file));
  }
  EXPECT_GT(read, 100);
}

TEST(PackedPng, LeavesToLibpngWhatItDoesNotKnow) {
  const HandMadePng plain{.width_px = 2, .height_px = 2, .levels = std::vector<int>(12, 7)};
  ASSERT_TRUE(read_packed_png(bytes_of(file_of(plain))));
  const auto is_read = [&](const auto& change) {
    HandMadePng png = plain;
    change(png);
    return read_packed_png(bytes_of(file_of(png))).has_value();
  };
  EXPECT_FALSE(is_read([](HandMadePng& png) { png.is_interlaced = true; }));
  EXPECT_FALSE(is_read([](HandMadePng& png) { png.bits = 16; }));
  EXPECT_FALSE(is_read([](HandMadePng& png) { png.filters = {5}; }));
  EXPECT_FALSE(is_read([](HandMadePng& png) { png.colour = PngColour::palette; }));
  for (const char* const chunk : {"acTL", "fcTL", "eXIf", "tRNS", "NEED"}) {
    EXPECT_FALSE(is_read([&](HandMadePng& png) { png.chunks = png_chunk(chunk, "123456"); }));
  }
  EXPECT_TRUE(is_read([](HandMadePng& png) { png.chunks = png_chunk("tEXt", "a"); }));
  // A colour that the palette does not have.
  EXPECT_FALSE(is_read([](HandMadePng& png) {
    png.colour = PngColour::palette;
    png.levels.resize(4);
    png.chunks = png_chunk("PLTE", std::string(7 * 3, '\0'));
  }));
}

/// libdeflate does not check that a stream looks back no further than it announces.
TEST(PackedPng, RefusesStreamsThatAnnounceASmallWindow) {
  const HandMadePng png{.width_px = 100, .height_px = 40, .levels = std::vector<int>(12000, 7)};
  std::string file = file_of(png);
  const std::size_t at = file.find("IDAT") + 4;
  file[at] = 0x18;  // 512 bytes
  file[at + 1] = 0x19;
  ASSERT_EQ((std::uint8_t(file[at]) * 256 + std::uint8_t(file[at + 1])) % 31, 0);
  const std::size_t end = file.find("IEND") - 8;
  const std::string chunk = png_chunk("IDAT", file.substr(at, end - at));
  EXPECT_FALSE(read_packed_png(bytes_of(file.substr(0, at - 8) + chunk + file.substr(end + 4))));
}

TEST(PackedPng, AsksForNoMemoryThatItsBytesCannotFill) {
  HandMadePng png{.levels = {1, 2, 3}};
  std::string file = file_of(png);
  const std::string header =
      big_endian(8192) + big_endian(8192) + file.substr(24, 5);  // depth, kind, methods
  file.replace(8, 25, png_chunk("IHDR", header));
  EXPECT_FALSE(read_packed_png(bytes_of(file)));
}

}  // namespace
}  // namespace piblocks
