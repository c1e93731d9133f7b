// PNG files of every kind that holds a picture, compared as they are packed: held to what libpng
// reads of them, and to the comparison of that.
#include <gtest/gtest.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "golden/packed_rows.hpp"
#include "golden/small_images.hpp"
#include "media/png/packed_png.hpp"
#include "media/png/png_reader.hpp"
#include "support/hand_made_png.hpp"
#include "support/temporary_folder.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::channels_of;
using testing_support::file_of;
using testing_support::HandMadePng;
using testing_support::png_chunk;
using testing_support::PngColour;
using testing_support::TemporaryFolder;

constexpr std::array kColours = {PngColour::grey, PngColour::rgb, PngColour::palette,
                                 PngColour::grey_alpha, PngColour::rgba};

Bytes in_memory(const std::string& file) { return {file.begin(), file.end()}; }

Image by_libpng(const std::string& file) {
  return std::get<Image>(read_png_samples("a.png", in_memory(file)));
}

void shuffle(Random& random, std::vector<std::uint32_t>& colours) {
  for (std::size_t i = colours.size() - 1; i > 0; --i) {
    std::swap(colours[i], colours[std::size_t(random.integer(0, std::int64_t(i)))]);
  }
}

/// The channels of a pixel in a file of this kind.
std::vector<int> levels_of(std::uint32_t word, PngColour colour,
                           const std::vector<std::uint32_t>& palette) {
  const auto level = [&](int shift) { return int(word >> shift & 0xff); };
  switch (colour) {
    case PngColour::grey:
      return {level(0)};
    case PngColour::grey_alpha:
      return {level(0), level(24)};
    case PngColour::rgb:
      return {level(16), level(8), level(0)};
    case PngColour::rgba:
      return {level(16), level(8), level(0), level(24)};
    case PngColour::palette:
      break;
  }
  return {int(std::ranges::find(palette, word) - palette.begin())};
}

/// A file of this kind with these pixels, in some order of its palette, with some filters or
/// interlaced, some compression, and perhaps a gamma.
std::string file_of_kind(Random& random, const Image& image, PngColour colour) {
  HandMadePng png{.width_px = image.width_px, .height_px = image.height_px, .colour = colour};
  std::vector<std::uint32_t> palette = image.words;
  std::ranges::sort(palette);
  palette.erase(std::unique(palette.begin(), palette.end()), palette.end());
  shuffle(random, palette);
  for (const std::uint32_t word : image.words) {
    const std::vector<int> levels = levels_of(word, colour, palette);
    png.levels.insert(png.levels.end(), levels.begin(), levels.end());
  }
  png.is_interlaced = random.integer(0, 3) == 0;
  for (std::int64_t i = png.is_interlaced ? 0 : random.integer(0, 5); i > 0; --i) {
    png.filters.push_back(int(random.integer(0, 4)));
  }
  png.compression = int(random.integer(0, 9));
  if (random.integer(0, 1) == 0) png.chunks = png_chunk("gAMA", testing_support::big_endian(45455));
  if (colour != PngColour::palette) return file_of(png);
  std::string colours;
  std::string alphas;
  for (const std::uint32_t word : palette) {
    for (const int shift : {16, 8, 0}) colours += char(word >> shift & 0xff);
    alphas += char(word >> 24);
  }
  png.chunks += png_chunk("PLTE", colours) + png_chunk("tRNS", alphas);
  return file_of(png);
}

/// Greys, so that every kind can hold them; of any alpha, or opaque.
Image random_greys(Random& random, bool is_opaque) {
  Image image = flat(int(random.integer(1, 20)), int(random.integer(1, 12)), 0);
  const std::int64_t last = random.integer(0, 1) == 0 ? 3 : 255;  // few or many levels
  for (std::uint32_t& word : image.words) {
    const auto alpha = std::uint32_t(is_opaque ? 255 : random.integer(0, 3) * 85);
    word = alpha << 24 | std::uint32_t(random.integer(0, last)) * 0x010101;
  }
  return image;
}

enum class Change { none, slight, all };

Image changed_greys(Random& random, Image image, Change change) {
  if (change == Change::none) return image;
  const auto last = std::int64_t(image.words.size()) - 1;
  if (change == Change::slight) {
    image.words.at(std::size_t(random.integer(0, last))) ^= 0x010101;
    return image;
  }
  for (std::uint32_t& word : image.words) word ^= 0x808080;
  return image;
}

/// All kinds that can hold a picture of greys.
std::vector<PngColour> kinds(bool is_opaque) {
  if (is_opaque) return {kColours.begin(), kColours.end()};
  return {PngColour::palette, PngColour::grey_alpha, PngColour::rgba};
}

Tolerance some_tolerance(Random& random) {
  Tolerance tolerance{.max_delta = Rational(long(random.integer(0, 2))),
                      .max_pixels = random.integer(0, 2)};
  if (random.integer(0, 2) == 0) tolerance.threshold = random.uniform(0, 0.2);
  tolerance.ignores_transparent = random.integer(0, 1) == 0;
  if (random.integer(0, 1) == 0) tolerance.window = Window{int(random.integer(1, 9)), 1};
  return tolerance;
}

/// A mask that leaves the first column of pictures that have more than one.
std::vector<PixelRect> some_masks(Random& random, const Image& image) {
  if (image.width_px == 1 || random.integer(0, 1) == 0) return {};
  return {{int(random.integer(1, image.width_px)), int(random.integer(0, 5)), 9, 9}};
}

/// The last byte of IHDR.
bool is_interlaced(const std::string& png) { return png.at(28) != 0; }

void expect_as_packed(const std::string& a, const std::string& b, const Tolerance& tolerance,
                      const std::vector<PixelRect>& masks) {
  const auto packed_a = read_packed_png(in_memory(a));
  const auto packed_b = read_packed_png(in_memory(b));
  EXPECT_EQ(packed_a.has_value(), !is_interlaced(a));
  EXPECT_EQ(packed_b.has_value(), !is_interlaced(b));
  if (!packed_a || !packed_b) return;
  const Image image_a = by_libpng(a);
  const Image image_b = by_libpng(b);
  expect_same(compare(*packed_a, *packed_b, tolerance, masks),
              compared(image_a, image_b, tolerance, masks));
  const bool ignores = tolerance.ignores_transparent;
  EXPECT_EQ(pixel_deltas(*packed_a, *packed_b, masks, ignores),
            pixel_deltas(image_a, image_b, masks, ignores));
}

class PackedCompareTest : public testing::Test {
 protected:
  /// What the comparison of two files finds.
  FrameComparison row_of(const std::string& a, const std::string& b,
                         const Tolerance& tolerance = {},
                         const std::vector<PixelRect>& masks = {}) const {
    ComparisonJob job{folder_.save("a.png", a), folder_.save("b.png", b), tolerance};
    if (!masks.empty()) job.masks = {{.text = "some", .rects = masks}};
    FrameComparison found;
    compare_files(job, [&](const FrameComparison& row) { found = row; });
    return found;
  }
  /// Damage is found whatever is beside it, the same damage included.
  void expect_unreadable(const std::string& whole, const std::string& broken,
                         const std::string& what) const {
    EXPECT_EQ(row_of(whole, whole).outcome, Outcome::equal) << what;
    EXPECT_EQ(row_of(broken, broken).outcome, Outcome::unreadable) << what;
    EXPECT_EQ(row_of(whole, broken).outcome, Outcome::unreadable) << what;
    EXPECT_EQ(row_of(broken, whole).outcome, Outcome::unreadable) << what;
  }

  TemporaryFolder folder_;
};

TEST_F(PackedCompareTest, EveryKindOfFileIsComparedAsWhatLibpngReadsOfIt) {
  TracedRandom random(81);
  for (std::int64_t i = many(60); i > 0; --i) {
    const bool is_opaque = i % 2 == 0;
    for (const Change change : {Change::none, Change::slight, Change::all}) {
      const Image a = random_greys(random, is_opaque);
      const Image b = changed_greys(random, a, change);
      const Tolerance tolerance = some_tolerance(random);
      const std::vector<PixelRect> masks = some_masks(random, a);
      for (const PngColour colour : kinds(is_opaque)) {
        const std::string file_a = file_of_kind(random, a, colour);
        ASSERT_EQ(by_libpng(file_a).words, a.words);
        expect_as_packed(file_a, file_of_kind(random, b, colour), tolerance, masks);
      }
    }
  }
}

TEST_F(PackedCompareTest, ThePictureCountsAndNotTheKindOfFile) {
  TracedRandom random(82);
  for (std::int64_t i = many(20); i > 0; --i) {
    const bool is_opaque = i % 2 == 0;
    for (const Change change : {Change::none, Change::slight, Change::all}) {
      const Image a = random_greys(random, is_opaque);
      const Image b = changed_greys(random, a, change);
      const Tolerance tolerance = some_tolerance(random);
      const Difference expected = compared(a, b, tolerance);
      for (const PngColour kind : kinds(is_opaque)) {
        const std::string file_a = file_of_kind(random, a, kind);
        for (const PngColour other : kinds(is_opaque)) {
          const auto row = row_of(file_a, file_of_kind(random, b, other), tolerance);
          ASSERT_TRUE(row.difference) << row.problem;
          expect_same(*row.difference, expected);
          EXPECT_EQ(row.deltas(), pixel_deltas(a, b, {}, tolerance.ignores_transparent));
        }
      }
    }
  }
}

/// Equal files take a shorter way.
TEST_F(PackedCompareTest, AFileEqualsItsCopy) {
  TracedRandom random(83);
  for (std::int64_t i = many(30); i > 0; --i) {
    const Image image = random_greys(random, true);
    for (const PngColour kind : kColours) {
      const std::string file = file_of_kind(random, image, kind);
      const auto row = row_of(file, file, some_tolerance(random));
      EXPECT_EQ(row.outcome, Outcome::equal) << row.problem;
      expect_same(row.difference.value(), compared(image, image));
      EXPECT_EQ(row.reference().words, image.words);
      EXPECT_EQ(row.deltas(), std::vector<std::uint8_t>(image.words.size()));
    }
  }
}

/// The file with another stream in its only chunk of pixels.
template <typename Edit>
std::string with_stream(const std::string& file, const Edit& edit) {
  const std::size_t at = file.find("IDAT");
  const std::size_t end = file.rfind("IEND") - 4;  // its length stands before it
  std::string stream = file.substr(at + 4, end - 4 - (at + 4));
  edit(stream);
  return file.substr(0, at - 4) + png_chunk("IDAT", stream) + file.substr(end);
}

TEST_F(PackedCompareTest, BrokenFilesAreRefusedWhateverIsBesideThem) {
  TracedRandom random(84);
  for (const PngColour kind : kColours) {
    const std::string whole = file_of_kind(random, random_greys(random, true), kind);
    const auto with_bit = [&](std::size_t at) {
      std::string broken = whole;
      broken.at(at) = char(broken.at(at) ^ 1);
      return broken;
    };
    const std::size_t pixels = whole.find("IDAT");
    const std::size_t end = whole.rfind("IEND");
    expect_unreadable(whole, with_bit(29), "checksum of the header");
    expect_unreadable(whole, with_bit(pixels + 6), "pixels");
    expect_unreadable(whole, with_bit(end - 5), "checksum of the pixels");
    expect_unreadable(whole, whole.substr(0, end - 20), "cut off in the pixels");
    expect_unreadable(whole, whole.substr(0, pixels - 4), "cut off in front of the pixels");
    expect_unreadable(whole, whole.substr(0, 8), "nothing but the signature");
    expect_unreadable(whole, with_stream(whole, [](std::string& s) { s.back() ^= 1; }), "Adler-32");
    expect_unreadable(whole, with_stream(whole, [](std::string& s) { s.resize(s.size() - 5); }),
                      "a stream without its end");
    expect_unreadable(whole, with_stream(whole, [](std::string& s) { s.clear(); }), "no pixels");
  }
}

TEST_F(PackedCompareTest, AnIndexWithoutAColourIsRefused) {
  HandMadePng png{.width_px = 2, .height_px = 2, .colour = PngColour::palette};
  png.chunks = png_chunk("PLTE", "abcdef");
  png.levels = {0, 1, 1, 0};
  const std::string whole = file_of(png);
  png.levels = {0, 1, 2, 0};
  expect_unreadable(whole, file_of(png), "a third colour of two");
}

/// The shorter way of equal files may not accept what libpng refuses, nor the other way round.
TEST_F(PackedCompareTest, ADamagedFileEqualsItselfOnlyIfLibpngReadsIt) {
  TracedRandom random(85);
  int read = 0;
  int refused = 0;
  for (std::int64_t i = many(400); i > 0; --i) {
    const PngColour kind = kColours.at(std::size_t(random.integer(0, 4)));
    std::string file = file_of_kind(random, random_greys(random, true), kind);
    const auto at = std::size_t(random.integer(0, std::int64_t(file.size()) - 1));
    if (i % 4 == 0) file.at(at) = char(random.integer(0, 255));
    if (i % 4 == 1) file.resize(at);
    if (i % 4 == 2) file = with_stream(file, [&](std::string& s) { s.at(at % s.size()) ^= 4; });
    if (i % 4 == 3) file = with_stream(file, [&](std::string& s) { s.append(at % 9, 'x'); });
    const std::string path = folder_.save("c.png", file);
    bool is_read = true;
    try {
      read_png_frame(path)->next();
    } catch (const Error&) {
      is_read = false;
    }
    ++(is_read ? read : refused);
    EXPECT_EQ(row_of(file, file).outcome, is_read ? Outcome::equal : Outcome::unreadable) << i;
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace piblocks
