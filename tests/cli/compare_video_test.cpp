// compare: files that are damaged, cut off, or more than they seem.
#include "cli/compare_fixture.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

class CompareVideoTest : public CompareFixture {
 protected:
  void render(const std::string& name, const Arguments& options = {}) const {
    output_of(Arguments{"render", "--quiet", "--theme", "article", "--size", "64x36", "--fps", "10",
                        "--to", "1", "-o", name} +
              options);
  }
};

const std::string kTestPicture = "-f lavfi -i testsrc2=s=64x48:d=1:r=10 ";

// libavcodec 59 ended the process where several threads came upon damage.
TEST_F(CompareVideoTest, DamagedMpeg4IsRefused) {
  if (!ffmpeg(kTestPicture + "-c:v mpeg4 a.avi")) GTEST_SKIP() << "no ffmpeg here";
  const std::string whole = contents("a.avi");
  EXPECT_EQ(compare({"a.avi", "a.avi"}).exit_code, 0);
  int refused = 0;
  for (std::size_t at = 6000; at < 9000; at += 150) {
    std::string damaged = whole;
    damaged.replace(at, 8, 8, '\x5a');
    write("b.avi", damaged);
    const CommandResult result = compare({"b.avi", "b.avi"});
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 5) << at << result.err;
    refused += result.exit_code == 5 ? 1 : 0;
  }
  EXPECT_GT(refused, 0);
}

// The decoder leaves what it could not read as the memory was.
TEST_F(CompareVideoTest, DamagedProresIsRefused) {
  render("a.mov", {"--encoder", "prores_ks"});
  const std::string whole = contents("a.mov");
  int refused = 0;
  for (std::size_t at = whole.size() / 4; at < whole.size() / 2; at += whole.size() / 80) {
    std::string damaged = whole;
    damaged.replace(at, 40, 40, '\xff');
    write("b.mov", damaged);
    const int code = compare({"b.mov", "b.mov"}).exit_code;
    EXPECT_TRUE(code == 0 || code == 5) << at << ": " << code;
    refused += code == 5 ? 1 : 0;
  }
  EXPECT_GT(refused, 10);
}

TEST_F(CompareVideoTest, WhatIsCutOffIsNotAShorterOne) {
  render("a.y4m");
  render("a.webm");
  render("a.gif");
  render("a.apng");
  std::vector<std::string> names = {"a.y4m", "a.webm", "a.gif", "a.apng"};
  if (ffmpeg(kTestPicture + "-c:v ffv1 a.mkv")) names.emplace_back("a.mkv");
  for (const std::string& name : names) {
    EXPECT_EQ(compare({name, name}).exit_code, 0) << name;
    const std::string whole = contents(name);
    const std::string cut = "cut" + name;
    write(cut, whole.substr(0, whole.size() - 1));
    expect_complaint({name, cut}, "'" + cut + "': it is cut off");
    write(cut, whole.substr(0, whole.size() * 9 / 10));
    EXPECT_TRUE(contains(compare({name, cut}).out, " frames differ, 1 unreadable"))
        << "the frames before are compared: " << name;
    for (std::size_t size = 1; size < whole.size(); size += whole.size() / 9) {
      write(cut, whole.substr(0, size));
      EXPECT_EQ(compare({cut, cut}).exit_code, 5) << name << " " << size;
    }
  }
}

// Its header has a tag of ours for the matrix, which FFmpeg has to be told.
TEST_F(CompareVideoTest, OurY4mIsBt709) {
  const Arguments options = {"render", "--size", "64x36", "--fps", "10", "--to", "1", "-o"};
  const CommandResult rendered = piblocks(options + Arguments{"a.y4m"});
  EXPECT_EQ(std::ranges::count_if(lines(rendered.err),
                                  [](const std::string& line) {
                                    return line.find("-colorspace bt709") != std::string::npos;
                                  }),
            1)
      << rendered.err;
  EXPECT_EQ(piblocks(options + Arguments{"b.y4m", "--quiet"}).err, "");
  std::string other = contents("a.y4m");
  other.replace(other.find("=BT709"), 6, "=OTHER");
  write("c.y4m", other);
  EXPECT_EQ(compare({"a.y4m", "b.y4m"}).exit_code, 0);
  EXPECT_EQ(compare({"a.y4m", "c.y4m"}).exit_code, 1);
  if (!ffmpeg("-colorspace bt709 -i a.y4m -c:v ffv1 told.mkv")) GTEST_SKIP() << "no ffmpeg here";
  ASSERT_TRUE(ffmpeg("-i a.y4m -c:v ffv1 untold.mkv"));
  EXPECT_EQ(compare({"a.y4m", "told.mkv"}).exit_code, 0);
  EXPECT_EQ(compare({"a.y4m", "untold.mkv"}).exit_code, 1);
}

// Nobody knows how long a live stream is going to be.
TEST_F(CompareVideoTest, AStreamThatDoesNotKnowItsSizeIsWhole) {
  if (!ffmpeg(kTestPicture + "-c:v ffv1 -f matroska -live 1 a.mkv")) {
    GTEST_SKIP() << "no ffmpeg here";
  }
  EXPECT_EQ(compare({"a.mkv", "a.mkv"}).exit_code, 0);
}

/// "5 frames before", or nothing.
std::string shift_in(const std::string& lines) {
  const std::string kBegin = "frames look like those of the reference ";
  const std::size_t at = lines.find(kBegin);
  return at == std::string::npos ? "" : lines.substr(at + kBegin.size());
}

TEST_F(CompareVideoTest, AShiftByWholeFramesIsTold) {
  const auto film = [&](const std::string& name, int first, const Arguments& options) {
    output_of(Arguments{"render", "--quiet", "--digits", "2", "--size", "160x90", "--fps", "30",
                        "--from", std::to_string(first) + "/30", "--to", "4", "-o", name} +
              options);
  };
  film("a.mp4", 30, {});
  for (const int shift : {-24, -7, -1, 1, 2, 13}) {
    film("b.y4m", 30 + shift, {});
    film("b.mp4", 30 + shift, {"--encoder", "libx264", "--crf", "23"});
    const std::string frames = shift * shift == 1 ? " frame " : " frames ";
    const std::string text =
        std::to_string(std::abs(shift)) + frames + (shift < 0 ? "before them" : "after them");
    for (const char* const name : {"b.y4m", "b.mp4"}) {
      EXPECT_EQ(shift_in(compare({"a.mp4", name}).out), text + '\n') << name;
    }
  }
}

TEST_F(CompareVideoTest, WhatDiffersOtherwiseIsNoShift) {
  const Arguments common = {"render", "--quiet", "--size", "160x90", "--fps", "30", "--to", "4"};
  output_of(common + Arguments{"--digits", "2", "-o", "a.mp4"});
  output_of(common + Arguments{"--digits", "3", "-o", "digits.mp4"});
  output_of(common + Arguments{"--digits", "2", "--theme", "lecture", "-o", "theme.mp4"});
  output_of(common + Arguments{"--digits", "2", "--encoder", "libx264", "-o", "encoder.mp4"});
  output_of(common + Arguments{"--digits", "2", "--speed", "1.04", "-o", "speed.mp4"});
  for (const char* const name : {"digits.mp4", "theme.mp4", "encoder.mp4", "speed.mp4"}) {
    const CommandResult result = compare({"a.mp4", name});
    EXPECT_NE(result.exit_code, 0) << name;
    EXPECT_EQ(shift_in(result.out), "") << name;
  }
}

TEST_F(CompareVideoTest, SeveralVideosInAFileAreRefused) {
  const std::string two = kTestPicture + "-f lavfi -i color=red:s=64x48:d=1:r=10 ";
  if (!ffmpeg(two + "-map 0 -map 1 a.mkv")) GTEST_SKIP() << "no ffmpeg here";
  ASSERT_TRUE(ffmpeg(kTestPicture + "b.mkv"));
  expect_complaint({"a.mkv", "b.mkv"}, "cannot compare 'a.mkv': it has 2 videos");
  expect_complaint({"b.mkv", "a.mkv"}, "cannot compare 'a.mkv': it has 2 videos");
}

TEST_F(CompareVideoTest, ACoverIsNoVideo) {
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "cover.png"});
  if (!ffmpeg(kTestPicture + "-pix_fmt yuv420p -c:v libx264 a.mp4")) {
    GTEST_SKIP() << "no ffmpeg here";
  }
  ASSERT_TRUE(
      ffmpeg("-i a.mp4 -i cover.png -map 0 -map 1 -c copy -disposition:v:1 attached_pic b.mp4"));
  EXPECT_EQ(compare({"a.mp4", "b.mp4"}).exit_code, 0);
}

// libavformat takes the first for the pattern of a sequence, and reads the second.
TEST_F(CompareVideoTest, APictureMayHaveAPercentSignInItsName) {
  const std::string picture = "P6 1 1 255\n";
  write("a%d.ppm", picture + "abc");
  write("a1.ppm", picture + "abd");
  write("b.ppm", picture + "abc");
  EXPECT_EQ(compare({"a%d.ppm", "b.ppm"}).exit_code, 0);
  EXPECT_EQ(compare({"a%d.ppm", "a1.ppm"}).exit_code, 1);
}

// Nobody would keep a report from being written over these.
TEST_F(CompareVideoTest, AListOfFilesIsRefused) {
  render("a.y4m");
  write("list", "ffconcat version 1.0\nfile a.y4m\n");
  expect_complaint({"list", "a.y4m"}, "cannot read 'list': it is a list of other files");
}

}  // namespace
}  // namespace piblocks
