// GIF and APNG, read back by our readers and by libavcodec: every pixel, every time.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <numeric>

#include "media/gif/color_table.hpp"
#include "media/libav/av_module.hpp"
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

/// The frames of a file, as they are compared.
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

/// The seconds for which each image is shown. A GIF has hundredths behind 21 f9 04 and a byte of
/// flags, an APNG two numbers in fcTL.
std::vector<Rational> delays_in(const std::string& path) {
  const bool is_gif = path.ends_with(".gif");
  const std::string bytes = file_contents(path);
  const auto byte = [&](std::size_t at) { return int{static_cast<unsigned char>(bytes.at(at))}; };
  std::vector<Rational> delays;
  const std::string mark = is_gif ? "\x21\xf9\x04" : "fcTL";
  for (std::size_t at = 0; (at = bytes.find(mark, at)) != std::string::npos; at += 8) {
    if (!is_gif) {
      delays.emplace_back(256 * byte(at + 24) + byte(at + 25), 256 * byte(at + 26) + byte(at + 27));
    } else if (byte(at + 7) == 0 && byte(at + 8) == ',') {  // else it is compressed data
      delays.emplace_back(byte(at + 4) + 256 * byte(at + 5), 100);
    }
  }
  return delays;
}

/// Whether libavcodec shows the right picture at every time, until the end.
void expect_times(const std::string& path, const Rational& rate, std::int64_t count,
                  const PaintFrame& paint) {
  const testing_support::DecodedVideo video = testing_support::decode_video(path);
  const Rational late_s(1, 200);
  const std::vector<Rational> delays = delays_in(path);
  const Rational end_s = std::accumulate(delays.begin(), delays.end(), Rational(0));
  EXPECT_LE(abs(end_s - count / rate), path.ends_with(".gif") ? late_s : Rational(0));
  auto shown = video.frames.begin();
  for (std::int64_t i = 0; i < count; ++i) {
    while (shown + 1 != video.frames.end() && (shown + 1)->time_s <= i / rate + late_s) ++shown;
    ASSERT_TRUE(shown->rgb.words == paint(i).words) << "frame " << i;
  }
}

/// How many images a file has.
std::size_t images_in(const std::string& path) {
  return testing_support::decode_video(path).frames.size();
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

TEST_P(Animation, AStandstillIsOneImage) {
  TracedRandom random(61);
  for (const char* rate : {"10", "25", "50", "24", "7"}) {
    SCOPED_TRACE(rate);
    const TemporaryFolder folder;
    const VideoFormat format = {.width_px = 40, .height_px = 3, .frame_rate = Rational(rate)};
    std::vector<std::uint32_t> pictures = {0};  // which one each frame shows
    while (pictures.size() < 170) {
      pictures.insert(pictures.end(), std::size_t(random.integer(1, 60)), pictures.back() + 1);
    }
    const PaintFrame paint = [&](std::int64_t number) {
      return random_frame(40, 3, pictures[std::size_t(number)]);
    };
    const std::int64_t count = std::ssize(pictures);
    write_frames_by_threads(folder / GetParam(), format, {}, count, paint);
    EXPECT_EQ(images_in(folder / GetParam()), pictures.back() + 1U);
    expect_frames(folder / GetParam(), count, paint);
    expect_times(folder / GetParam(), format.frame_rate, count, paint);
  }
}

/// A delay has 16 bits.
TEST_P(Animation, ALongStandstillIsSeveralImages) {
  const bool is_gif = std::string(GetParam()) == "a.gif";
  for (const auto& [rate, longest] : {std::pair("1/3", is_gif ? 218 : 21845),
                                      {"60000/1001", is_gif ? 0 : 65},
                                      {"1/655", is_gif ? 1 : 100}}) {
    if (longest == 0) continue;
    SCOPED_TRACE(rate);
    const TemporaryFolder folder;
    const VideoFormat format = {.width_px = 40, .height_px = 30, .frame_rate = Rational(rate)};
    const PaintFrame paint = [&](std::int64_t /*number*/) { return article_frames(format)(1); };
    write_frames_by_threads(folder / GetParam(), format, {}, 300, paint);
    EXPECT_EQ(images_in(folder / GetParam()), std::size_t((300 + longest - 1) / longest));
    expect_frames(folder / GetParam(), 300, paint);
    expect_times(folder / GetParam(), format.frame_rate, 300, paint);
  }
}

/// Also at the beginning of a chunk.
TEST_P(Animation, AnImageHasOnlyWhatChanges) {
  const TemporaryFolder folder;
  const VideoFormat format = {.width_px = 300, .height_px = 200, .frame_rate = 10};
  const PaintFrame paint = [&](std::int64_t number) {
    Pixels pixels(300, 200);
    for (auto& word : pixels.words) word = 0xffffffff;
    for (int x = 0; x < 5; ++x) pixels.at(int(number) + x, 77) = 0xff2654cc;
    return pixels;
  };
  write_frames(folder / GetParam(), format, {}, 1, paint);
  const auto first = file_contents(folder / GetParam()).size();
  write_frames(folder / GetParam(), format, {}, 200, paint);
  EXPECT_LT(file_contents(folder / GetParam()).size(), first + 199 * 90);
  expect_times(folder / GetParam(), 10, 200, paint);
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

/// Images of up to 192 colours more share a table, each of the others has its own; all sizes of
/// codes.
TEST(Gif, HoldsAnyPixelsOf256Colours) {
  TracedRandom random(89);
  const TemporaryFolder folder;
  const VideoFormat format = {.width_px = 230, .height_px = 170, .frame_rate = 10};
  std::vector<Pixels> pictures(1, random_frame(230, 170, 0));
  for (auto& word : pictures[0].words) word &= 0xffc0e0c0;  // 32 colours
  for (const int colours : {1, 2, 3, 4, 5, 17, 100, 192, 150, 255, 256, 100, 256, 2}) {
    Pixels next = random_frame(230, 170, std::uint32_t(pictures.size()));
    const auto salt = std::uint32_t(random.integer(0, 0xffff)) << 8;
    const bool is_noise = random.integer(0, 1) == 1;
    for (std::size_t i = 0; i < next.words.size(); ++i) {
      const bool is_kept = colours < 256 && next.words[i] >> 20 & 1;
      const auto value = is_noise ? next.words[i] % std::uint32_t(colours)
                                  : std::uint32_t(i / 7) % std::uint32_t(colours);
      next.words[i] = is_kept ? pictures.back().words[i] : 0xff000000 | (salt + value);
    }
    pictures.push_back(next);
  }
  const PaintFrame paint = [&](std::int64_t number) { return pictures[std::size_t(number)]; };
  const auto count = std::ssize(pictures);
  write_frames(folder / "a.gif", format, {}, count, paint);
  expect_frames(folder / "a.gif", count, paint);
  expect_times(folder / "a.gif", 10, count, paint);
}

TEST(Gif, TimesDoNotDrift) {
  for (const char* rate : {"50", "48", "30", "30000/1001", "24", "7", "1/3"}) {
    const TemporaryFolder folder;
    const VideoFormat format = {.width_px = 8, .height_px = 6, .frame_rate = Rational(rate)};
    write_frames(folder / "a.gif", format, {}, 240, random_frames(format));
    const std::vector<Rational> delays = delays_in(folder / "a.gif");
    ASSERT_EQ(delays.size(), 240u) << rate;
    Rational time_cs = 0;
    for (std::size_t i = 0; i < delays.size(); ++i) {
      EXPECT_GE(100 * delays[i], 2) << rate;
      time_cs += 100 * delays[i];
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
