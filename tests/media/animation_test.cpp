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

using testing_support::decode_video;

/// What a viewer shows until the next image.
struct Shown {
  Rational duration_s;
  std::vector<std::uint32_t> words;
};

std::uint32_t little_endian_at(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  while (count-- > 0) value = value << 8 | static_cast<unsigned char>(bytes.at(at + count));
  return value;
}

/// By the container's specification; libavcodec decodes no more of it than each picture.
std::vector<Shown> shown_in_webp(const std::string& path) {
  const TemporaryFolder folder;
  const std::string bytes = file_contents(path);
  const auto number = [&](std::size_t at, std::size_t count) {
    return little_endian_at(bytes, at, count);
  };
  EXPECT_EQ(bytes.substr(8, 8), "WEBPVP8X");
  EXPECT_EQ(number(4, 4), bytes.size() - 8);
  const std::size_t width = number(24, 3) + 1;
  std::vector<std::uint32_t> words(width * (number(27, 3) + 1));
  std::vector<Shown> shown;
  for (std::size_t at = 12; at < bytes.size(); at += 8 + number(at + 4, 4)) {
    if (bytes.substr(at, 4) != "ANMF") continue;
    const std::string picture = "WEBP" + bytes.substr(at + 24, number(at + 4, 4) - 16);
    std::string size;
    for (int shift = 0; shift < 32; shift += 8) size += static_cast<char>(picture.size() >> shift);
    const Pixels image = decode_video(folder.save("a.webp", "RIFF" + size + picture)).frames[0].rgb;
    EXPECT_EQ(image.width_px, int(number(at + 14, 3)) + 1);
    const bool is_blended = (bytes[at + 23] & 2) == 0;
    for (int y = 0; y < image.height_px; ++y) {
      for (int x = 0; x < image.width_px; ++x) {
        const std::uint32_t word = image.at(x, y);
        if (is_blended && word >> 24 == 0) continue;
        EXPECT_TRUE(!is_blended || word >> 24 == 255);
        const std::size_t row = 2 * number(at + 11, 3) + std::size_t(y);
        words.at(row * width + 2 * number(at + 8, 3) + std::size_t(x)) = word;
      }
    }
    shown.push_back({Rational(number(at + 20, 3), 1000), words});
  }
  return shown;
}

/// A GIF has hundredths of a second behind 21 f9 04 and a byte of flags, an APNG two numbers in
/// fcTL.
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

/// Decoded by libavcodec, which has no part of what encodes.
std::vector<Shown> images_in(const std::string& path) {
  if (path.ends_with(".webp")) return shown_in_webp(path);
  const std::vector<Rational> delays = delays_in(path);
  const testing_support::DecodedVideo video = decode_video(path);
  EXPECT_EQ(video.frames.size(), delays.size());
  std::vector<Shown> shown;
  for (std::size_t i = 0; i < delays.size(); ++i) {
    const Rational late_s =
        i == 0 ? Rational(0)
               : abs(video.frames[i].time_s - video.frames[i - 1].time_s - delays[i - 1]);
    EXPECT_LT(late_s, Rational(1, 1000));
    shown.push_back({delays[i], video.frames[i].rgb.words});
  }
  return shown;
}

/// Whether the right picture is shown at every time, until the end. @return how many images there
/// are
std::size_t expect_times(const std::string& path, const Rational& rate, std::int64_t count,
                         const PaintFrame& paint) {
  const Rational late_s =
      path.ends_with(".apng") ? 0 : Rational(1, path.ends_with(".gif") ? 200 : 2000);
  const std::vector<Shown> images = images_in(path);
  Rational end_s;
  std::int64_t frame = 0;
  for (const Shown& image : images) {
    end_s += image.duration_s;
    for (; frame < count && frame / rate < end_s - late_s; ++frame) {
      EXPECT_TRUE(image.words == paint(frame).words) << "frame " << frame;
    }
    EXPECT_LE(abs(frame / rate - end_s), late_s) << "frame " << frame;
  }
  EXPECT_EQ(frame, count);
  return images.size();
}

class Animation : public testing::TestWithParam<const char*> {
 protected:
  /// libavcodec 59 to 61 decode no animated WebP.
  static bool can_be_read() { return std::string(GetParam()) != "a.webp"; }
};

TEST_P(Animation, ShowsEveryPixelOfEveryFrame) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {64, 36}, {251, 83}}) {
    const VideoFormat format = {.width_px = width, .height_px = height, .frame_rate = 10};
    write_frames(folder / GetParam(), format, {}, 130, article_frames(format));
    expect_times(folder / GetParam(), 10, 130, article_frames(format));
    if (can_be_read()) expect_frames(folder / GetParam(), 130, article_frames(format));
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
    EXPECT_EQ(expect_times(folder / GetParam(), format.frame_rate, count, paint),
              pictures.back() + 1U);
    if (can_be_read()) expect_frames(folder / GetParam(), count, paint);
  }
}

/// A delay has 16 bits, or 24 of milliseconds. Delays above 2^31 / 100,000 s overflow in
/// libavformat.
TEST_P(Animation, ALongStandstillIsSeveralImages) {
  struct Longest {
    const char* rate;
    int gif, apng, webp;  // frames; 0 if the rate is not for it
  };
  const std::string kind = GetParam();
  for (const auto& [rate, gif, apng, webp] :
       {Longest{"1/3", 218, 21845, 5592}, {"60000/1001", 0, 65, 1005}, {"1/655", 1, 0, 25}}) {
    const int longest = kind == "a.gif" ? gif : kind == "a.webp" ? webp : apng;
    if (longest == 0) continue;
    SCOPED_TRACE(rate);
    const TemporaryFolder folder;
    const VideoFormat format = {.width_px = 40, .height_px = 30, .frame_rate = Rational(rate)};
    const PaintFrame paint = [&](std::int64_t /*number*/) { return article_frames(format)(1); };
    write_frames_by_threads(folder / GetParam(), format, {}, 300, paint);
    EXPECT_EQ(expect_times(folder / GetParam(), format.frame_rate, 300, paint),
              std::size_t((300 + longest - 1) / longest));
    if (can_be_read()) expect_frames(folder / GetParam(), 300, paint);
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
    const std::string mark = is_gif ? "NETSCAPE2.0\x03\x01"
                             : std::string(GetParam()) == "a.webp"
                                 ? std::string("ANIM\6\0\0\0\0\0\0\0", 12)
                                 : std::string("acTL\0\0\0\x03", 8);
    const std::size_t at = bytes.find(mark);
    EXPECT_EQ(at == std::string::npos, is_gif && plays == 1);
    if (at == std::string::npos) continue;
    const auto byte = [&](std::size_t i) {
      return int{static_cast<unsigned char>(bytes.at(at + mark.size() + i))};
    };
    const bool is_big_endian = std::string(GetParam()) == "a.apng";
    const int number = is_big_endian ? 256 * byte(2) + byte(3) : byte(0) + 256 * byte(1);
    EXPECT_EQ(number, plays ? *plays - (is_gif ? 1 : 0) : 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Animation, testing::Values("a.gif", "a.apng", "a.webp"));

TEST(Animation, HoldsAnyColours) {
  const TemporaryFolder folder;
  const VideoFormat format = {.width_px = 70, .height_px = 50, .frame_rate = 60};
  for (const char* name : {"a.apng", "a.webp"}) {
    write_frames(folder / name, format, {}, 70, random_frames(format));
    expect_times(folder / name, 60, 70, random_frames(format));
  }
  expect_frames(folder / "a.apng", 70, random_frames(format));
}

/// Frames whose pixels become transparent and opaque again, stored with straight alpha.
TEST(Animation, HoldsAnyAlpha) {
  const VideoFormat format = {.width_px = 31, .height_px = 23, .frame_rate = 25, .has_alpha = true};
  const auto frame = [](std::int64_t number, std::uint32_t half) {
    Pixels pixels = random_frame(31, 23, std::uint32_t(number / 3));
    for (auto& word : pixels.words) {
      if (word >> 8 & 1) word = word >> 9 & 1 ? half : 0;
    }
    return pixels;
  };
  for (const char* name : {"a.apng", "a.webp"}) {
    const TemporaryFolder folder;
    const auto output = set_up_output(folder / name, format, {});
    const auto encoder = output.make_encoder();
    const auto sink = output.open({40});
    encoder->begin(0);
    for (std::int64_t i = 0; i < 40; ++i) add(*encoder, with_alpha(frame(i, 0x80402000)));
    sink->append(encoder->finish());
    sink->finish();
    const PaintFrame straight = [&](std::int64_t number) { return frame(number, 0x80804000); };
    EXPECT_EQ(expect_times(folder / name, 25, 40, straight), 14U);
  }
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
