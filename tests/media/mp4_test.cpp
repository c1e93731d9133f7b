#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

#include "media/libav/av.hpp"
#include "media/output/output.hpp"
#include "media/write_frames.hpp"
#include "support/contains.hpp"
#include "support/decode_video.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
using testing_support::ColourTags;
using testing_support::contains;
using testing_support::decode_video;
using testing_support::DecodedPacket;
using testing_support::DecodedVideo;
using testing_support::file_contents;
using testing_support::TemporaryFolder;

const VideoFormat kFormat = {
    .width_px = 322, .height_px = 180, .frame_rate = Rational("30000/1001")};
constexpr std::int64_t kFramesPerChunk = 29;  // floor(29.97)

bool has_x264() {
  const std::vector<std::string> names = encoder_names(EncoderKind::h264);
  return std::ranges::find(names, "libx264") != names.end();
}

class Mp4Test : public testing::Test {
 protected:
  void SetUp() override {
    if (encoder_names(EncoderKind::h264).empty()) GTEST_SKIP() << "libavcodec has no H.264 encoder";
  }

  DecodedVideo written_and_read(const EncoderSettings& settings, std::int64_t frames,
                                const VideoFormat& format = kFormat) const {
    write_frames(folder_ / "out.mp4", format, settings, frames, article_frames(format));
    return decode_video(folder_ / "out.mp4");
  }

  std::string problem(const EncoderSettings& settings) const {
    const std::string said = testing_support::message_of<UsageError>(
        [&] { set_up_output(folder_ / "out.mp4", kFormat, settings); });
    EXPECT_TRUE(said.empty() || folder_.is_empty());
    return said;
  }

  TemporaryFolder folder_;
};

TEST_F(Mp4Test, ShowsEveryFrameAtItsExactTime) {
  constexpr std::int64_t kFrames = 2 * kFramesPerChunk + 1;  // the last chunk has one frame
  const DecodedVideo video = written_and_read({}, kFrames);
  EXPECT_EQ(video.codec, "h264");
  EXPECT_EQ(video.width_px, kFormat.width_px);
  EXPECT_EQ(video.height_px, kFormat.height_px);
  EXPECT_EQ(video.frame_rate, kFormat.frame_rate);
  EXPECT_EQ(video.duration_s, Rational(kFrames) / kFormat.frame_rate);
  ASSERT_EQ(video.frames.size(), std::size_t{kFrames});
  for (std::int64_t i = 0; i < kFrames; ++i) {
    EXPECT_EQ(video.frames[static_cast<std::size_t>(i)].time_s, Rational(i) / kFormat.frame_rate);
  }
}

TEST_F(Mp4Test, EveryChunkAndNothingElseStartsWithAKeyFrame) {
  // By default a chunk may change its encoder, at a key frame: h264_chunk_test.cpp.
  const DecodedVideo video =
      written_and_read({.encoder = encoder_names(EncoderKind::h264).front()}, 3 * kFramesPerChunk);
  for (std::size_t i = 0; i < video.frames.size(); ++i) {
    EXPECT_EQ(video.frames[i].key_frame, i % kFramesPerChunk == 0) << i;
  }
}

TEST_F(Mp4Test, TellsItsColoursInTheContainerAndInThePictures) {
  const DecodedVideo video = written_and_read({}, 2);
  EXPECT_EQ(video.container.matrix, "bt709");
  EXPECT_EQ(video.container.primaries, "bt709");
  EXPECT_EQ(video.container.transfer, "bt709");
  EXPECT_EQ(video.container.range, "tv");
  const ColourTags expected = {.matrix = "bt709",
                               .primaries = "bt709",
                               .transfer = "bt709",
                               .range = "tv",
                               .chroma_location = "left"};
  EXPECT_EQ(video.pictures, expected);
}

/// Noise of 128x96 pixels: 9 Mbit/s, of which level 2 allows 2.
TEST_F(Mp4Test, SaysAHigherLevelWhereThePicturesNeedIt) {
  const VideoFormat format = {.width_px = 128, .height_px = 96, .frame_rate = 60};
  const auto levels_of = [&](const char* name, const EncoderSettings& settings,
                             const PaintFrame& paint) {
    write_frames(folder_ / name, format, settings, 120, paint);
    const AvInputPtr file = open_av_input(folder_ / name);
    const std::uint8_t* const headers = file->streams[0]->codecpar->extradata;
    return std::pair(int(headers[3]), int(headers[8 + 3]));  // in avcC, in its parameter set
  };
  const EncoderSettings builtin = {.encoder = "builtin"};
  const auto raised = levels_of("noise.mp4", builtin, random_frames(format));
  EXPECT_GT(raised.first, 20);
  EXPECT_EQ(raised.first, raised.second);
  EXPECT_EQ(levels_of("noise.mov", builtin, random_frames(format)), raised);
  for (const char* name : {"article.mp4", "article.mov"}) {
    EXPECT_EQ(levels_of(name, builtin, article_frames(format)), std::pair(20, 20)) << name;
  }
}

TEST_F(Mp4Test, EqualFramesGiveEqualChunksAfterAnyUseOfMemory) {
  const VideoFormat format = {.width_px = 64, .height_px = 48, .frame_rate = 10};
  if (!has_x264()) GTEST_SKIP() << "presets are libx264's";
  const auto output = set_up_output(folder_ / "out.mp4", format, {.preset = "veryfast"});
  std::vector<EncodedChunk> chunks(16);
  for (std::size_t pair = 0; pair < chunks.size(); pair += 2) {
    const auto encode = [&](std::size_t i) {
      chunks[i] = encode_chunk(output, 10, 20, article_frames(format));
    };
    const std::jthread other(encode, pair);
    encode(pair + 1);
  }
  for (const EncodedChunk& chunk : chunks) {
    EXPECT_TRUE(std::ranges::equal(chunk, chunks.front(), {}, &Packet::bytes, &Packet::bytes));
  }
}

TEST_F(Mp4Test, HoldsOneSignatureOfTheEncoder) {
  if (!has_x264()) GTEST_SKIP() << "only libx264 signs";
  written_and_read({.encoder = "libx264"}, 3 * kFramesPerChunk);
  const std::string bytes = file_contents(folder_ / "out.mp4");
  const std::size_t first = bytes.find("x264 - core");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(bytes.find("x264 - core", first + 1), std::string::npos);
  // By default the first picture is not libx264's.
  written_and_read({}, 3 * kFramesPerChunk);
  EXPECT_EQ(file_contents(folder_ / "out.mp4").find("x264 - core"), std::string::npos);
}

TEST_F(Mp4Test, TimeStampsIncreaseAcrossChunksAlsoWithBFrames) {
  if (!has_x264()) GTEST_SKIP() << "presets are libx264's";
  for (const char* preset : {"ultrafast", "medium", "veryslow"}) {
    const DecodedVideo video = written_and_read({.preset = preset}, 2 * kFramesPerChunk + 2);
    EXPECT_TRUE(std::ranges::is_sorted(video.packets, std::less_equal<>(), &DecodedPacket::dts));
    EXPECT_EQ(video.packets.front().pts, 0);
    const bool reordered = std::ranges::any_of(
        video.packets, [](const DecodedPacket& packet) { return packet.pts != packet.dts; });
    EXPECT_EQ(reordered, preset != std::string("ultrafast")) << preset;
    for (std::size_t i = 0; i < video.frames.size(); ++i) {
      EXPECT_EQ(video.frames[i].time_s, Rational(i) / kFormat.frame_rate) << preset;
    }
  }
}

TEST_F(Mp4Test, TakesUnusualFrameRates) {
  for (const char* rate : {"1/3", "1", "24000/1001", "12345/67", "1000", "1000000/1"}) {
    const VideoFormat format = {.width_px = 64, .height_px = 36, .frame_rate = Rational(rate)};
    const DecodedVideo video = written_and_read({}, 5, format);
    ASSERT_EQ(video.frames.size(), 5u) << rate;
    EXPECT_EQ(video.frames[4].time_s, 4 / format.frame_rate) << rate;
  }
}

/// libavformat has 31 bits for the duration of a frame.
TEST_F(Mp4Test, AFrameLastsAsLongAsTheFileCanSay) {
  for (const long numerator : {1L, 3L, 7L, 999L, 10'000L}) {
    long doubled = 1;
    while (numerator * doubled < 10'000) doubled *= 2;
    const long longest = ((1L << 31) - 2) / doubled;
    VideoFormat format = {.width_px = 16, .height_px = 16};
    format.frame_rate = Rational(numerator, longest);
    format.frame_rate.canonicalize();
    const DecodedVideo video = written_and_read({}, 3, format);
    ASSERT_EQ(video.frames.size(), 3u) << numerator;
    EXPECT_EQ(video.frames[2].time_s, 2 / format.frame_rate) << numerator;
  }
  EXPECT_THROW(
      set_up_output(folder_ / "out.mp4",
                    {.width_px = 16, .height_px = 16, .frame_rate = Rational(1, 131072)}, {}),
      UsageError);
}

TEST_F(Mp4Test, BetterQualityTakesMoreBytes) {
  written_and_read({.crf = 12}, 30);
  const std::size_t good = file_contents(folder_ / "out.mp4").size();
  written_and_read({.crf = 40}, 30);
  EXPECT_LT(file_contents(folder_ / "out.mp4").size(), good);
}

TEST_F(Mp4Test, TakesAPathThatLooksLikeAProtocol) {
  write_frames(folder_ / "pipe:1.mp4", kFormat, {}, 2, article_frames(kFormat));
  EXPECT_EQ(decode_video(folder_ / "pipe:1.mp4").frames.size(), 2u);
}

TEST_F(Mp4Test, NamesTheSettingThatIsWrong) {
  if (!has_x264()) GTEST_SKIP() << "the settings are libx264's";
  EXPECT_TRUE(contains(problem({.crf = 51.5}), "crf 51.5"));
  EXPECT_TRUE(contains(problem({.crf = -1}), "crf -1"));
  EXPECT_TRUE(contains(problem({.crf = std::nan("")}), "crf nan"));
  EXPECT_TRUE(contains(problem({.preset = "fastest"}), "'fastest'; use one of: ultrafast"));
  EXPECT_TRUE(contains(problem({.preset = ""}), "''"));
  EXPECT_TRUE(contains(problem({.encoder = "libx263"}), "'libx263'; use one of: builtin, libx264"));
  for (const std::string other : {"damage", "libx264rgb", "ffv1", "mpeg4", "libsvtav1"}) {
    EXPECT_TRUE(contains(problem({.encoder = other}), "'; use one of: builtin, libx264")) << other;
  }
  EXPECT_TRUE(contains(problem({.crf = 20, .encoder = "builtin"}), "'builtin' has no crf"));
  EXPECT_TRUE(
      contains(problem({.preset = "fast", .encoder = "builtin"}), "'builtin' has no presets"));
  EXPECT_TRUE(contains(problem({.crf = 99, .preset = "x"}),
                       "crf 99 is out of range; use 1 (best) "
                       "to 51\nvideo: encoder 'libx264' has no"));
}

TEST(H264Encoders, AreOnesThatCanBeOpened) {
  for (const std::string& name : encoder_names(EncoderKind::h264)) {
    const TemporaryFolder folder;
    EXPECT_NO_THROW(set_up_output(folder / "out.mp4", kFormat, {.encoder = name})) << name;
  }
}

}  // namespace
}  // namespace piblocks
