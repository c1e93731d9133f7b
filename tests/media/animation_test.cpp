// GIF and APNG, read back by libavcodec: every pixel, every time.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include "media/libav/av_module.hpp"
#include "media/libav/color_table.hpp"
#include "media/output/output.hpp"
#include "media/write_frames.hpp"
#include "support/decode_video.hpp"
#include "support/temporary_folder.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::file_contents;
using testing_support::Pixels;
using testing_support::random_frame;
using testing_support::TemporaryFolder;

/// The frames of a file, as libavformat shows them.
std::vector<Image> shown(const std::string& path) {
  std::vector<Image> frames;
  const auto reader = read_video(path);
  while (reader->next()) frames.push_back(std::get<Image>(reader->rgb()));
  return frames;
}

void expect_frames(const std::string& path, std::int64_t count, const PaintFrame& paint) {
  const std::vector<Image> frames = shown(path);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    ASSERT_TRUE(frames[static_cast<std::size_t>(i)].words == paint(i).words) << "frame " << i;
  }
}

class Animation : public testing::TestWithParam<const char*> {};

TEST_P(Animation, ShowsEveryPixelOfEveryFrame) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {64, 36}, {251, 83}}) {
    const VideoFormat format = {.width_px = width, .height_px = height, .frame_rate = 10};
    write_frames(folder / GetParam(), format, {}, 130, article_frames(format));
    expect_frames(folder / GetParam(), 130, article_frames(format));
  }
}

TEST_P(Animation, AFrameMayBeTheSameAsTheOneBefore) {
  const TemporaryFolder folder;
  const VideoFormat format = {.width_px = 40, .height_px = 30, .frame_rate = 10};
  const PaintFrame paint = [&](std::int64_t number) { return article_frames(format)(number / 7); };
  write_frames(folder / GetParam(), format, {}, 120, paint);
  expect_frames(folder / GetParam(), 120, paint);
}

/// A GIF that plays once does not speak of it; else the number is that of repetitions.
TEST_P(Animation, PlaysForEverOrAsOftenAsItIsTold) {
  const bool is_gif = std::string(GetParam()) == "a.gif";
  const TemporaryFolder folder;
  const VideoFormat format = {.width_px = 40, .height_px = 30, .frame_rate = 10};
  for (const std::optional<int> plays : {std::optional<int>(), {1}, {2}, {300}, {kMaxPlays}}) {
    write_frames(folder / GetParam(), format, {.plays = plays}, 3, article_frames(format));
    const std::string bytes = file_contents(folder / GetParam());
    const std::string mark = is_gif ? "NETSCAPE2.0\x03\x01" : std::string("acTL\0\0\0\x03", 8);
    const std::size_t at = bytes.find(mark);
    EXPECT_EQ(at == std::string::npos, is_gif && plays == 1);
    if (at == std::string::npos) continue;
    const auto byte = [&](std::size_t i) {
      return int{static_cast<unsigned char>(bytes.at(at + mark.size() + i))};
    };
    const int number = is_gif ? byte(0) + 256 * byte(1) : 256 * byte(2) + byte(3);
    EXPECT_EQ(number, plays ? *plays - (is_gif ? 1 : 0) : 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Animation, testing::Values("a.gif", "a.apng"));

TEST(Apng, HoldsAnyColours) {
  const TemporaryFolder folder;
  const VideoFormat format = {.width_px = 70, .height_px = 50, .frame_rate = 60};
  write_frames(folder / "a.apng", format, {}, 70, random_frames(format));
  expect_frames(folder / "a.apng", 70, random_frames(format));
}

/// Delays in the file, in the order of its frames: behind 21 f9 04 and a byte of flags.
std::vector<int> gif_delays(const std::string& bytes) {
  std::vector<int> delays;
  for (std::size_t at = 0; (at = bytes.find("\x21\xf9\x04", at)) != std::string::npos; at += 8) {
    delays.push_back(static_cast<unsigned char>(bytes.at(at + 4)) +
                     256 * static_cast<unsigned char>(bytes.at(at + 5)));
  }
  return delays;
}

TEST(Gif, TimesDoNotDrift) {
  for (const char* rate : {"50", "48", "30", "30000/1001", "24", "7", "1/3"}) {
    const TemporaryFolder folder;
    const VideoFormat format = {.width_px = 8, .height_px = 6, .frame_rate = Rational(rate)};
    write_frames(folder / "a.gif", format, {}, 240, article_frames(format));
    const std::vector<int> delays = gif_delays(file_contents(folder / "a.gif"));
    ASSERT_EQ(delays.size(), 240u) << rate;
    Rational time_cs = 0;
    for (std::size_t i = 0; i < delays.size(); ++i) {
      EXPECT_GE(delays[i], 2) << rate;
      time_cs += delays[i];
      const Rational late_cs = time_cs - 100 * Rational(i + 1) / format.frame_rate;
      EXPECT_LE(abs(late_cs), Rational(1, 2)) << rate << ", frame " << i;
    }
  }
}

TEST(Gif, OfTooManyColoursKeepsThoseOfFlatAreas) {
  const TemporaryFolder folder;
  const VideoFormat format = {.width_px = 90, .height_px = 60, .frame_rate = 10};
  const auto paint = [&](std::int64_t number) {
    Pixels pixels = random_frame(90, 60, static_cast<std::uint32_t>(number));
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) pixels.at(x, y) = y < 30 ? 0xff2654cc : 0xffd63028;
    }
    return pixels;
  };
  write_frames(folder / "a.gif", format, {}, 5, paint);
  const std::vector<Image> frames = shown(folder / "a.gif");
  ASSERT_EQ(frames.size(), 5u);
  for (const Image& frame : frames) {
    for (std::size_t y = 0; y < 60; ++y) {
      for (std::size_t x = 0; x < 60; ++x) {
        ASSERT_EQ(frame.words[y * 90 + x], y < 30 ? 0xff2654cc : 0xffd63028) << x << ' ' << y;
      }
    }
  }
}

/// What lights up is a few pixels among the many shades of edges.
TEST(ColorTable, KeepsAFewPixelsOfAColourOfTheirOwn) {
  constexpr std::uint32_t kAccent = 0xffd166;
  ColorTable table;
  table.count(kAccent);
  for (std::uint32_t shade = 0; shade < 1000; ++shade) {
    for (int pixels = 0; pixels < 50; ++pixels)
      table.count(0x200000 + 0x0102 * (shade % 250) + shade / 250);
  }
  table.choose(255);
  EXPECT_EQ(table.colors()[table.index_of(kAccent)], kAccent);
}

TEST(ColorTable, GivesEveryColourTheNearestThatIsKept) {
  TracedRandom random(256);
  for (const std::size_t room : {1U, 7U, 255U, 256U}) {
    ColorTable table;
    std::vector<std::uint32_t> colors;
    for (int i = 0; i < 600; ++i) {
      colors.push_back(static_cast<std::uint32_t>(random.integer(0, 0xffffff)));
      table.count(colors.back());
    }
    table.count(colors[42]);  // the most frequent
    table.choose(room);
    ASSERT_EQ(table.colors().size(), room);
    EXPECT_EQ(table.colors()[table.index_of(colors[42])], colors[42]);
    const auto distance = [](std::uint32_t a, std::uint32_t b) {
      int sum = 0;
      for (const int shift : {0, 8, 16}) {
        const int d = static_cast<int>(a >> shift & 0xff) - static_cast<int>(b >> shift & 0xff);
        sum += d * d;
      }
      return sum;
    };
    for (const std::uint32_t color : colors) {
      const int found = distance(color, table.colors()[table.index_of(color)]);
      for (const std::uint32_t other : table.colors()) EXPECT_LE(found, distance(color, other));
    }
  }
}

}  // namespace
}  // namespace piblocks
