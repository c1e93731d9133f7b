// compare: what is stored is compared, at any depth and in any arrangement, and nothing else.
#include "cli/compare_fixture.hpp"
#include "support/hand_made_png.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;
using testing_support::big_endian;
using testing_support::file_of;
using testing_support::HandMadePng;
using testing_support::png_chunk;
using testing_support::PngColour;

class CompareDepthTest : public CompareFixture {
 protected:
  void write_png(const std::string& name, int bits, int level,
                 const std::string& chunks = {}) const {
    HandMadePng png{.width_px = 8, .height_px = 8, .bits = bits, .colour = PngColour::rgb};
    png.levels.assign(8 * 8 * 3, level);
    png.chunks = chunks;
    write(name, file_of(png));
  }
  /// One frame of YUV4MPEG2, 8x8 in 4:2:0, that has the same level everywhere but at one place.
  void write_y4m(const std::string& name, const std::string& kind, int bytes, int level,
                 int first) const {
    std::string text = "YUV4MPEG2 W8 H8 F5:1 C" + kind + "\nFRAME\n";
    for (int i = 0; i < 8 * 8 + 2 * 4 * 4; ++i) {
      const int sample = i == 0 ? first : level;
      text += static_cast<char>(sample & 0xff);
      if (bytes == 2) text += static_cast<char>(sample >> 8);
    }
    write(name, text);
  }
  /// By ffmpeg, if it is there, from its test picture.
  bool convert(const std::string& filter, const std::string& options,
               const std::string& name) const {
    return ffmpeg("-f lavfi -i testsrc=s=64x48:d=0.4:r=5" + filter + " " + options + " " + name);
  }
};

TEST_F(CompareDepthTest, TheLeastLevelOfSixteenBitsIsADifference) {
  write_png("a.png", 16, 0x8000);
  write_png("b.png", 16, 0x8001);
  const CommandResult result = compare({"a.png", "b.png"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.out, "largest delta 0.00390 of 255 (1 of 65535), first"));
  EXPECT_EQ(compare({"a.png", "b.png", "--max-delta", "0.00390"}).exit_code, 0);
  EXPECT_EQ(compare({"a.png", "b.png", "--max-delta", "1/257"}).exit_code, 0);
  EXPECT_EQ(compare({"a.png", "b.png", "--max-delta", "1/258"}).exit_code, 1);
}

TEST_F(CompareDepthTest, TheLeastLevelOfADeepVideoIsADifference) {
  for (const int bits : {10, 12, 16}) {
    const std::string kind = "420p" + std::to_string(bits);
    write_y4m("a.y4m", kind, 2, 300, 300);
    write_y4m("b.y4m", kind, 2, 300, 301);
    EXPECT_EQ(compare({"a.y4m", "a.y4m"}).exit_code, 0);
    const CommandResult result = compare({"a.y4m", "b.y4m", "--diff", "d"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(contains(result.out, "frame 0: 1 pixel differs"));
    EXPECT_TRUE(contains(result.out, "(1 of " + std::to_string((1 << bits) - 1) + ")"));
  }
}

TEST_F(CompareDepthTest, WhatIsPrintedAcceptsWhatItIsPrintedOf) {
  for (const int level : {1, 2, 77, 128, 4095, 32767, 65535}) {
    write_png("a.png", 16, 0);
    write_png("b.png", 16, level);
    const std::string out = compare({"a.png", "b.png"}).out;
    const std::string behind = out.substr(out.find("delta ") + 6);
    const std::string printed = behind.substr(0, behind.find(' '));
    EXPECT_EQ(compare({"a.png", "b.png", "--max-delta", printed}).exit_code, 0) << printed;
  }
}

TEST_F(CompareDepthTest, EightBitsEqualTheSameInSixteen) {
  for (const int level : {0, 1, 127, 200, 255}) {
    write_png("a.png", 8, level);
    write_png("b.png", 16, 257 * level);
    EXPECT_EQ(compare({"a.png", "b.png"}).exit_code, 0) << level;
    write_png("b.png", 16, level == 255 ? 65534 : 257 * level + 1);
    EXPECT_EQ(compare({"a.png", "b.png"}).exit_code, 1) << level;
  }
}

TEST_F(CompareDepthTest, SamplesAreComparedNotWhatAGammaMakesOfThem) {
  write_png("a.png", 8, 100);
  write_png("b.png", 8, 100, png_chunk("gAMA", big_endian(100000)));
  EXPECT_EQ(compare({"a.png", "b.png"}).exit_code, 0);
}

TEST_F(CompareDepthTest, ADifferenceIsMarkedThoughItsPicturesLookTheSame) {
  write_png("a.png", 16, 0x8000);
  write_png("b.png", 16, 0x8001);
  EXPECT_EQ(compare({"a.png", "b.png", "--diff", "ab"}).exit_code, 1);
  HandMadePng expected{.width_px = 8, .height_px = 8, .bits = 8, .colour = PngColour::rgb};
  for (int i = 0; i < 8 * 8; ++i) {
    for (const int level : {255, 160, 160}) expected.levels.push_back(level);
  }
  write("expected.png", file_of(expected));
  EXPECT_EQ(compare({"expected.png", "ab/a-diff.png"}).exit_code, 0);
  EXPECT_EQ(compare({"b.png", "ab/a-actual.png"}).exit_code, 0) << "of 16 bits";
}

TEST_F(CompareDepthTest, InterleavedChromaIsCompared) {
  if (!convert(",format=yuv420p", "-c:v rawvideo", "a.nut")) GTEST_SKIP() << "no ffmpeg here";
  for (const std::string format : {"nv12", "nv21"}) {
    ASSERT_TRUE(convert(",format=yuv420p", "-c:v rawvideo -pix_fmt " + format, "b.nut"));
    EXPECT_EQ(compare({"b.nut", "b.nut"}).exit_code, 0) << format;
    EXPECT_EQ(compare({"a.nut", "b.nut"}).exit_code, 0) << format;
    ASSERT_TRUE(convert(",drawbox=x=20:y=20:w=1:h=1:color=red", "-c:v rawvideo -pix_fmt " + format,
                        "c.nut"));
    EXPECT_EQ(compare({"b.nut", "c.nut"}).exit_code, 1) << format;
  }
}

TEST_F(CompareDepthTest, AlphaOfAVideoIsCompared) {
  const std::string alpha = ",format=yuva420p,colorchannelmixer=aa=";
  if (!convert(alpha + "0.5", "-c:v ffv1", "a.mkv")) GTEST_SKIP() << "no ffmpeg here";
  ASSERT_TRUE(convert(alpha + "0.6", "-c:v ffv1", "b.mkv"));
  EXPECT_TRUE(contains(compare({"a.mkv", "b.mkv"}).out, "(alpha)"));
  ASSERT_TRUE(convert(alpha + "0.5", "-c:v libvpx-vp9 -b:v 0 -crf 1", "a.webm"));
  ASSERT_TRUE(convert(alpha + "0.9", "-c:v libvpx-vp9 -b:v 0 -crf 1", "b.webm"));
  EXPECT_EQ(compare({"a.webm", "a.webm"}).exit_code, 0);
  EXPECT_EQ(compare({"a.webm", "b.webm", "--max-delta", "50"}).exit_code, 1);
}

TEST_F(CompareDepthTest, FloatingPointIsRefusedByName) {
  if (!convert("", "-frames:v 1 -pix_fmt gbrpf32le", "a.exr")) GTEST_SKIP() << "no ffmpeg here";
  expect_complaint({"a.exr", "a.exr"}, "pixel format gbrpf32le");
}

TEST_F(CompareDepthTest, EveryFrameOfAnAnimatedPngIsCompared) {
  output_of({"render", "--quiet", "--size", "64x36", "--fps", "5", "--to", "1", "-o", "a.apng"});
  output_of({"render", "--quiet", "--size", "64x36", "--fps", "5", "--to", "1", "--speed", "2",
             "-o", "b.apng"});
  for (const std::string name : {"a", "b"}) {
    fs::rename(folder_ / (name + ".apng"), folder_ / (name + ".png"));
  }
  EXPECT_EQ(compare({"a.png", "a.png"}).exit_code, 0);
  EXPECT_NE(compare({"a.png", "b.png"}).exit_code, 0);
  fs::create_directory(folder_ / "f");
  fs::rename(folder_ / "b.png", folder_ / "f/b.png");
  expect_complaint({"f", "f"}, "it is animated");
}

TEST_F(CompareDepthTest, AVideoWithoutFramesIsNotEqualToItself) {
  write("a.y4m", "YUV4MPEG2 W8 H8 F5:1 C420\n");
  expect_complaint({"a.y4m", "a.y4m"}, "there is no frame in 'a.y4m'");
}

TEST_F(CompareDepthTest, AllOfALineOfHashesIsCompared) {
  const std::string header = "#format: frame checksums\n";
  write("a.framehash", header + "0, 0, 0, 1, 1, aa");
  write("b.framehash", header + "0, 0, 0, 1, 1, ab");
  EXPECT_EQ(compare({"a.framehash", "a.framehash"}).exit_code, 0);
  EXPECT_EQ(compare({"a.framehash", "b.framehash"}).exit_code, 1);
  for (const std::string& line :
       {std::string("0,0,0,1,1,aa\0bb", 15), std::string("0,0,0,1,1,"), std::string("0,0,,1,1,aa"),
        std::string("0,0,0,1,aa"), std::string("0,0,0,1,1,aa,bb")}) {
    write("b.framehash", header + line + "\n");
    expect_complaint({"a.framehash", "b.framehash"}, "line 2 is no hash of a frame");
  }
  write("b.framehash", header + std::string("#\0x\n", 4) + "0,0,0,1,1,aa\n");
  write("c.framehash", header + std::string("#\0y\n", 4) + "0,0,0,1,1,aa\n");
  EXPECT_EQ(compare({"b.framehash", "c.framehash"}).exit_code, 4);
}

TEST_F(CompareDepthTest, FramesMayChangeTheirSizeAndFormat) {
  if (!convert(",scale=32:24", "-c:v mjpeg -pix_fmt yuvj420p", "a.mjpeg")) {
    GTEST_SKIP() << "no ffmpeg here";
  }
  ASSERT_TRUE(convert("", "-c:v mjpeg -pix_fmt yuvj420p", "b.mjpeg"));
  ASSERT_TRUE(convert(",scale=32:24", "-c:v mjpeg -pix_fmt yuvj444p", "c.mjpeg"));
  write("aa.mjpeg", contents("a.mjpeg") + contents("a.mjpeg"));
  write("ab.mjpeg", contents("a.mjpeg") + contents("b.mjpeg"));
  write("ac.mjpeg", contents("a.mjpeg") + contents("c.mjpeg"));
  EXPECT_EQ(compare({"ab.mjpeg", "ab.mjpeg"}).exit_code, 0);
  EXPECT_EQ(compare({"ac.mjpeg", "ac.mjpeg", "--report", "r.html"}).exit_code, 0);
  EXPECT_EQ(compare({"aa.mjpeg", "ab.mjpeg"}).exit_code, 4);
  EXPECT_EQ(compare({"aa.mjpeg", "ac.mjpeg", "--report", "r.html"}).exit_code, 1);
}

TEST_F(CompareDepthTest, HowAVideoIsShownIsPartOfIt) {
  if (!convert("", "-c:v libx264", "a.mp4")) GTEST_SKIP() << "no ffmpeg here";
  const auto copied = [&](const std::string& options, const std::string& name,
                          const std::string& input_options = "") {
    return ffmpeg(input_options + " -i a.mp4 -c copy " + options + " " + name);
  };
  // From FFmpeg 6 on by the one, before by the other.
  ASSERT_TRUE(copied("", "turned.mp4", "-display_rotation 180") ||
              copied("-metadata:s:v rotate=180", "turned.mp4"));
  ASSERT_TRUE(copied("-aspect 2:1", "wide.mp4"));
  for (const std::string other : {"turned.mp4", "wide.mp4"}) {
    EXPECT_EQ(compare({other, other}).exit_code, 0);
    const CommandResult result = compare({"a.mp4", other});
    EXPECT_EQ(result.exit_code, 4) << result.out;
    EXPECT_TRUE(contains(result.out, "shown another way: "));
  }
  ASSERT_TRUE(copied("-bsf:v h264_metadata=video_full_range_flag=1", "full.mp4"));
  EXPECT_EQ(compare({"a.mp4", "full.mp4"}).exit_code, 1);
}

TEST_F(CompareDepthTest, AnMp4ThatIsCutOffIsNotAShorterOne) {
  output_of({"render", "--quiet", "--size", "64x36", "--fps", "10", "--to", "2", "-o", "a.mp4"});
  const std::string whole = contents("a.mp4");
  for (std::size_t size = 0; size < whole.size(); size += whole.size() / 23) {
    write("b.mp4", whole.substr(0, size));
    const CommandResult result = compare({"b.mp4", "b.mp4"});
    EXPECT_EQ(result.exit_code, 5) << size << result.out;
    EXPECT_EQ(lines(result.err).size(), 1U) << result.err;
  }
}

}  // namespace
}  // namespace piblocks
