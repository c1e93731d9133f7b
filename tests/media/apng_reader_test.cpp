// Animated PNG files that no encoder of ours writes: whole ones, and what is wrong with others.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "media/png/png_reader.hpp"
#include "support/contains.hpp"
#include "support/hand_made_png.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::big_endian;
using testing_support::file_of;
using testing_support::HandMadePng;
using testing_support::png_chunk;
using testing_support::PngColour;
using testing_support::TemporaryFolder;

struct MadeFrame {
  int x = 0;
  int y = 0;
  HandMadePng picture;
  int disposal = 0;
  int blend = 0;
};

/// The data of the IDAT chunk, which is the one before the last.
std::string compressed(const HandMadePng& picture) {
  const std::string file = file_of(picture);
  const std::size_t start = file.rfind("IDAT") + 4;
  return file.substr(start, file.size() - 12 - 4 - start);
}

/// The chunks of an animation, to be damaged one by one.
struct MadeApng {
  std::string header;  ///< with the signature
  std::vector<std::string> chunks;

  std::string file() const {
    std::string bytes = header;
    for (const std::string& chunk : chunks) bytes += chunk;
    return bytes;
  }
};

std::string control_of(const MadeFrame& frame, std::uint32_t sequence) {
  std::string data = big_endian(sequence);
  for (const int value : {frame.picture.width_px, frame.picture.height_px, frame.x, frame.y}) {
    data += big_endian(static_cast<std::uint32_t>(value));
  }
  return data + std::string("\0\1\0\12", 4) + static_cast<char>(frame.disposal) +
         static_cast<char>(frame.blend);
}

/// @param cover  whether a picture that is no frame comes first.
MadeApng apng_of(const std::vector<MadeFrame>& frames, bool cover = false,
                 const std::string& palette = {}) {
  const std::string first = file_of(frames[0].picture);
  MadeApng apng{first.substr(0, 8 + 25), {}};
  const auto add = [&](const std::string& type, const std::string& data) {
    apng.chunks.push_back(png_chunk(type, data));
  };
  add("acTL", big_endian(static_cast<std::uint32_t>(frames.size())) + big_endian(0));
  if (!palette.empty()) apng.chunks.push_back(palette);
  if (cover) add("IDAT", compressed(frames[0].picture));
  std::uint32_t sequence = 0;
  for (const MadeFrame& frame : frames) {
    const bool is_fdat = cover || sequence > 0;
    add("fcTL", control_of(frame, sequence++));
    const std::string data = compressed(frame.picture);
    if (!is_fdat) {
      add("IDAT", data.substr(0, 5));  // data may be cut anywhere
      add("IDAT", "");
      add("IDAT", data.substr(5));
    } else {
      add("fdAT", big_endian(sequence++) + data.substr(0, 3));
      add("fdAT", big_endian(sequence++) + data.substr(3));
    }
  }
  add("IEND", "");
  return apng;
}

HandMadePng random_picture(Random& random, int width, int height, int bits, PngColour colour) {
  HandMadePng png{.width_px = width, .height_px = height, .bits = bits, .colour = colour};
  const int greatest = (1 << bits) - 1;
  for (int i = width * height * testing_support::channels_of(colour); i > 0; --i) {
    const auto kind = random.integer(0, 3);
    png.levels.push_back(kind == 0   ? 0
                         : kind == 1 ? greatest
                                     : static_cast<int>(random.integer(0, greatest)));
  }
  return png;
}

std::vector<MadeFrame> random_animation(Random& random, int count, int bits, PngColour colour,
                                        int width = 13, int height = 9) {
  std::vector<MadeFrame> frames;
  for (int i = 0; i < count; ++i) {
    const int w = i == 0 ? width : static_cast<int>(random.integer(1, width));
    const int h = i == 0 ? height : static_cast<int>(random.integer(1, height));
    frames.push_back({.x = static_cast<int>(random.integer(0, width - w)),
                      .y = static_cast<int>(random.integer(0, height - h)),
                      .picture = random_picture(random, w, h, bits, colour),
                      .disposal = static_cast<int>(random.integer(0, 2)),
                      .blend = static_cast<int>(random.integer(0, 1))});
    frames.back().picture.is_interlaced = frames[0].picture.is_interlaced;
  }
  return frames;
}

class ApngReaderTest : public testing::Test {
 protected:
  std::vector<AnyImage> frames_of(const std::string& bytes) const {
    std::vector<AnyImage> frames;
    const auto reader = read_apng(folder_.save("a.png", bytes));
    while (reader->next()) frames.push_back(reader->samples());
    return frames;
  }
  void expect_refusal(const std::string& bytes, const std::string& what) const {
    const std::string said = testing_support::message_of<MediaError>([&] { frames_of(bytes); });
    EXPECT_NE(said, "") << "nothing is wrong; expected: " << what;
    EXPECT_TRUE(testing_support::contains(said, what));
  }

  TemporaryFolder folder_;
};

/// Red, green, blue and alpha of every pixel, from 0 to 1.
using Colours = std::vector<std::array<double, 4>>;

Colours shown_after(const std::vector<MadeFrame>& frames, std::size_t count) {
  const int width = frames[0].picture.width_px;
  Colours screen(std::size_t(width * frames[0].picture.height_px));
  for (std::size_t i = 0; i < count; ++i) {
    const MadeFrame& frame = frames[i];
    const Colours before = screen;
    const double greatest = (1 << frame.picture.bits) - 1;
    for (int pixel = 0; pixel < frame.picture.width_px * frame.picture.height_px; ++pixel) {
      const int x = frame.x + pixel % frame.picture.width_px;
      const int y = frame.y + pixel / frame.picture.width_px;
      auto& under = screen.at(std::size_t(y * width + x));
      std::array<double, 4> colour{};
      for (std::size_t c = 0; c < 4; ++c) {
        colour.at(c) = frame.picture.levels.at(std::size_t(pixel) * 4 + c) / greatest;
      }
      const double alpha = colour[3] + under[3] * (1 - colour[3]);
      for (std::size_t c = 0; frame.blend == 1 && c < 3; ++c) {
        const double sum = colour.at(c) * colour[3] + under.at(c) * under[3] * (1 - colour[3]);
        colour.at(c) = alpha == 0 ? 0 : sum / alpha;
      }
      if (frame.blend == 1) colour[3] = alpha;
      under = colour;
    }
    if (i + 1 == count || frame.disposal == 0) continue;
    if (frame.disposal == 2 && i > 0) {
      screen = before;
      continue;
    }
    for (int y = frame.y; y < frame.y + frame.picture.height_px; ++y) {
      for (int x = frame.x; x < frame.x + frame.picture.width_px; ++x) {
        screen.at(std::size_t(y * width + x)) = {};
      }
    }
  }
  return screen;
}

template <typename Picture>
double worst_error(const Picture& picture, double max_level, const Colours& expected) {
  constexpr int kBits = sizeof picture.words[0] * 2;
  double worst = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t place = c == 3 ? 3 : 2 - c;
      const std::uint64_t word = picture.words.at(i);
      const auto level = double(word >> (place * kBits) & ((std::uint64_t{1} << kBits) - 1));
      worst = std::max(worst, std::abs(level - expected.at(i).at(c) * max_level));
    }
  }
  return worst;
}

TEST_F(ApngReaderTest, ShowsWhatFramesLeaveAndCover) {
  TracedRandom random(71);
  for (int i = 0; i < 60; ++i) {
    const int bits = i % 2 == 0 ? 8 : 16;
    auto frames = random_animation(random, 7, bits, PngColour::rgba);
    for (MadeFrame& frame : frames) frame.picture.is_interlaced = i % 3 == 0;
    const auto shown = frames_of(apng_of(frames, i % 5 == 0).file());
    ASSERT_EQ(shown.size(), frames.size());
    // Later, a colour that is nearly transparent has been rounded to few levels.
    for (std::size_t k = 0; k < 2; ++k) {
      const Colours expected = shown_after(frames, k + 1);
      const double worst = bits == 8 ? worst_error(std::get<Image>(shown[k]), 255, expected)
                                     : worst_error(std::get<DeepImage>(shown[k]), 65535, expected);
      EXPECT_LT(worst, 0.51) << i << " frame " << k;
    }
  }
}

TEST_F(ApngReaderTest, FramesShareThePalette) {
  HandMadePng picture{.width_px = 4, .height_px = 1, .bits = 2, .colour = PngColour::palette};
  picture.levels = {0, 1, 2, 1};
  HandMadePng other = picture;
  other.levels = {2, 2, 1, 0};
  const std::string palette =
      png_chunk("PLTE", "abcdefghi") + png_chunk("tRNS", std::string("\xff\x80\0", 3));
  const auto shown =
      frames_of(apng_of({{.picture = picture}, {.picture = other}}, false, palette).file());
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(std::get<Image>(shown[1]).words,
            (std::vector<std::uint32_t>{0x00676869, 0x00676869, 0x80646566, 0xff616263}));
  other.levels[2] = 3;
  expect_refusal(apng_of({{.picture = picture}, {.picture = other}}, false, palette).file(),
                 "colour 3 of a palette of 3");
}

/// Only the data has to follow the first fcTL.
TEST_F(ApngReaderTest, TakesHeaderChunksAroundTheFirstControl) {
  const std::string palette =
      png_chunk("PLTE", std::string("\xff\0\0\0\xff\0", 6)) + png_chunk("tRNS", "\x40");
  HandMadePng picture{.width_px = 2, .height_px = 1, .bits = 8, .colour = PngColour::palette};
  picture.levels = {0, 1};
  MadeApng apng = apng_of({{.picture = picture}, {.picture = picture}}, false, palette);
  const auto words_of = [&] {
    std::vector<std::vector<std::uint32_t>> words;
    for (const AnyImage& frame : frames_of(apng.file()))
      words.push_back(std::get<Image>(frame).words);
    return words;
  };
  const auto expected = words_of();
  ASSERT_EQ(expected.size(), 2U);
  EXPECT_EQ(expected[0], (std::vector<std::uint32_t>{0x40ff0000, 0xff00ff00}));
  std::swap(apng.chunks[1], apng.chunks[2]);  // acTL, fcTL, PLTE and tRNS
  EXPECT_EQ(words_of(), expected);
  std::swap(apng.chunks[0], apng.chunks[1]);  // fcTL, acTL, PLTE and tRNS
  EXPECT_EQ(words_of(), expected);
  std::swap(apng.chunks[2], apng.chunks[3]);  // behind data they are too late
  EXPECT_THROW(words_of(), MediaError);
}

TEST_F(ApngReaderTest, RefusesWhatIsCutOffOrDamagedAnywhere) {
  TracedRandom random(72);
  const auto apng = apng_of(random_animation(random, 3, 8, PngColour::rgba, 2, 2));
  const std::string whole = apng.file();
  ASSERT_EQ(frames_of(whole).size(), 3U);
  EXPECT_EQ(frames_of(whole + "trailing data").size(), 3U);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_THROW(frames_of(whole.substr(0, i)), MediaError) << i;
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    EXPECT_THROW(frames_of(damaged), MediaError) << i;
  }
}

TEST_F(ApngReaderTest, RefusesChunksThatAreMissingDoubledOrSwapped) {
  TracedRandom random(73);
  const auto apng = apng_of(random_animation(random, 4, 8, PngColour::rgb));
  for (std::size_t i = 0; i < apng.chunks.size(); ++i) {
    if (apng.chunks[i] == png_chunk("IDAT", "")) continue;  // has no meaning
    SCOPED_TRACE(i);
    MadeApng missing = apng;
    missing.chunks.erase(missing.chunks.begin() + std::ptrdiff_t(i));
    EXPECT_THROW(frames_of(missing.file()), MediaError);
    const std::string type = apng.chunks[i].substr(4, 4);
    if (type == "fcTL" || type == "fdAT") {
      MadeApng doubled = apng;
      doubled.chunks.insert(doubled.chunks.begin() + std::ptrdiff_t(i), apng.chunks[i]);
      EXPECT_THROW(frames_of(doubled.file()), MediaError);
    }
    // acTL and the first fcTL may come in either order.
    if (i > 1 && apng.chunks[i - 1] != png_chunk("IDAT", "")) {
      MadeApng swapped = apng;
      std::swap(swapped.chunks[i - 1], swapped.chunks[i]);
      EXPECT_THROW(frames_of(swapped.file()), MediaError);
    }
  }
}

TEST_F(ApngReaderTest, SaysWhatIsWrong) {
  TracedRandom random(74);
  const auto frames = random_animation(random, 3, 8, PngColour::rgb);
  const MadeApng apng = apng_of(frames);
  const auto with = [&](std::size_t at, const std::string& type, const std::string& data) {
    MadeApng changed = apng;
    changed.chunks.at(at) = png_chunk(type, data);
    return changed.file();
  };
  expect_refusal(with(0, "acTL", big_endian(9) + big_endian(0)), "announces 9 frames and has 3");
  expect_refusal(with(0, "acTL", big_endian(2) + big_endian(0)), "announces 2 frames and has more");
  const std::size_t second = 5;  // behind acTL, fcTL and three IDAT
  MadeFrame frame = frames[1];
  expect_refusal(with(second, "fcTL", control_of(frame, 2)), "out of order");
  frame.x = 13;
  expect_refusal(with(second, "fcTL", control_of(frame, 1)), "fcTL: invalid values");
  frame = frames[1];
  frame.disposal = 3;
  expect_refusal(with(second, "fcTL", control_of(frame, 1)), "fcTL: invalid values");
  expect_refusal(with(second, "fcTL", control_of(frames[1], 1) + "x"), "fcTL: invalid length");
  // Checksums are right here, but rows are missing.
  const std::string data = compressed(frames[1].picture);
  expect_refusal(with(second + 2, "fdAT", big_endian(3) + data.substr(3, data.size() / 2)), "");
}

}  // namespace
}  // namespace piblocks
