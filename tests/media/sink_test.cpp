#include <gtest/gtest.h>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <string>

#include "media/output/output.hpp"
#include "media/pixels/yuv.hpp"
#include "media/png/png_chunk.hpp"
#include "media/write_frames.hpp"
#include "support/contains.hpp"
#include "support/decode_video.hpp"
#include "support/message_of.hpp"
#include "support/ordinary_user.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;
using testing_support::contains;
using testing_support::file_contents;
using testing_support::ordinary_user_problem;
using testing_support::OrdinaryUser;
using testing_support::Pixels;
using testing_support::TemporaryFolder;

const VideoFormat kSmall = {.width_px = 64, .height_px = 36, .frame_rate = 10};

/// The error of opening, or "" if it works.
std::string opening_error(const std::string& name, const VideoFormat& format,
                          const EncoderSettings& settings = {}) {
  return testing_support::message_of<UsageError>(
      [&] { set_up_output(name, format, settings).open({1000}); });
}

TEST(SetUpOutput, ListsTheKindsWhenANameHasNone) {
  for (const char* output : {"out.avi", "out", "", "mp4", "null.txt", "./null", "out.mp4/"}) {
    const std::string what = opening_error(output, kSmall);
    EXPECT_TRUE(contains(what, std::string("'") + output + "'"));
    for (const char* kind : {"*.mp4", "*.mov", "*.webm", "*.gif", "*.apng", "*.png", "%06d",
                             "*.y4m", "- (", "*.framehash", "null", "*.wav (sound alone)"}) {
      EXPECT_TRUE(contains(what, kind));
    }
    EXPECT_EQ(std::ranges::count(what, '\n'), 0) << what;
  }
}

TEST(SetUpOutput, ReportsAllProblemsAtOnce) {
  try {
    set_up_output("out.avi", {0, 20000, -1}, {});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(error.problems().size(), 3u) << error.what();
  }
}

TEST(SetUpOutput, RefusesFramesThatDoNotFitInMemoryOrTime) {
  EXPECT_TRUE(contains(opening_error("null", {16384, 16384, 60}), "16384x16384"));
  EXPECT_TRUE(contains(opening_error("null", {10, 10, 0}), "30000/1001"));
  EXPECT_TRUE(contains(opening_error("null", {10, 10, Rational("1/9000000000")}), "out of range"));
  EXPECT_EQ(opening_error("null", {16384, 4096, 60}), "");
}

TEST(SetUpOutput, RefusesEncoderSettingsThatWouldBeIgnored) {
  EXPECT_TRUE(contains(opening_error("out.y4m", kSmall, {.crf = 20}), "has no use for"));
  EXPECT_TRUE(contains(opening_error("%d.png", kSmall, {.preset = "slow"}), "*.mp4"));
}

TEST(SetUpOutput, SaysWhatCanBeTransparent) {
  const TemporaryFolder folder;
  VideoFormat format = kSmall;
  format.has_alpha = true;
  for (const char* name : {"out.mp4", "out.gif", "out.y4m", "-"}) {
    const std::string what = opening_error(name, format);
    EXPECT_TRUE(contains(what, std::string("'") + name + "' cannot be transparent"));
    EXPECT_TRUE(contains(what, "*.mov, *.webm, *.apng, *.webp, *.png"));
    EXPECT_TRUE(what.ends_with(", *.framehash")) << what;
  }
  for (const char* name :
       {"out.mov", "out.webm", "out.apng", "out.webp", "%d.png", "out.framehash"}) {
    EXPECT_EQ(opening_error(folder / name, format), "") << name;
  }
}

TEST(SetUpOutput, RefusesRatesThatAPictureFileCannotTell) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(opening_error("a.gif", {10, 10, 60}), "use --fps 50 or 25"));
  EXPECT_TRUE(contains(opening_error("a.gif", {10, 10, Rational("1/1000")}), "too low"));
  EXPECT_EQ(opening_error(folder / "a.gif", {10, 10, 50}), "");
  EXPECT_TRUE(contains(opening_error("a.apng", {10, 10, Rational("65536/1")}), "up to 65535"));
  EXPECT_EQ(opening_error(folder / "a.apng", {10, 10, Rational("60000/1001")}), "");
  EXPECT_TRUE(contains(opening_error("a.webp", {10, 10, 91}), "use 90 or less"));
  EXPECT_TRUE(contains(opening_error("a.webp", {10, 10, Rational("1/16778")}), "a frame in 16777"));
  EXPECT_TRUE(contains(opening_error("a.webp", {16384, 10, 60}), "sides of 1 to 16383"));
  EXPECT_EQ(opening_error(folder / "a.webp", {16383, 10, 90}), "");
}

TEST(SetUpOutput, TellsWhyAnEncoderOfMovOrWebmIsNoGood) {
  VideoFormat format = kSmall;
  EXPECT_TRUE(
      contains(opening_error("a.webm", format, {.encoder = "libx264"}), "use one of: libvpx-vp9"));
  EXPECT_TRUE(contains(opening_error("a.webm", format, {.crf = 64}), "use 0 (best) to 63"));
  EXPECT_TRUE(contains(opening_error("a.webm", format, {.crf = 10.5}),
                       "crf 10.5 is no whole number, as *.webm needs; use 10 or 11"));
  EXPECT_TRUE(contains(opening_error("a.webm", format, {.preset = "fast"}), "has no presets"));
  EXPECT_TRUE(
      contains(opening_error("a.mov", format, {.encoder = "nope"}), "cannot use encoder 'nope'"));
  EXPECT_TRUE(contains(opening_error("a.mov", format, {.encoder = "vp9"}), ", prores_ks"));
  EXPECT_FALSE(contains(opening_error("a.mp4", format, {.encoder = "vp9"}), "prores_ks"));
  format.has_alpha = true;
  EXPECT_TRUE(contains(opening_error("a.mov", format, {.encoder = "libx264"}), "use prores_ks"));
  EXPECT_TRUE(contains(opening_error("a.mov", format, {.crf = 3, .preset = "slow"}), "has no crf"));
  EXPECT_TRUE(contains(opening_error("a.webm", format, {.encoder = "av1"}), "use vp9"));
}

TEST(SetUpOutput, SaysWhichEvenSizeToUse) {
  const TemporaryFolder folder;
  for (const char* name : {"out.mp4", "out.mov", "out.webm", "out.y4m"}) {
    EXPECT_TRUE(contains(opening_error(folder / name, {1921, 1081, 60}), "use 1920x1080"));
    EXPECT_TRUE(contains(opening_error(folder / name, {1, 10, 60}), "use 2x10"));
  }
  EXPECT_TRUE(folder.is_empty());
  EXPECT_EQ(opening_error(folder / "%d.png", {1921, 1081, 60}), "");
  EXPECT_EQ(opening_error(folder / "out.framehash", {1921, 1081, 60}), "");
  EXPECT_EQ(opening_error(folder / "out.gif", {1921, 1081, 25}), "");
  EXPECT_EQ(opening_error(folder / "out.apng", {1921, 1081, 60}), "");
  EXPECT_EQ(opening_error(folder / "out.mov", {1921, 1081, 60, true}), "");
}

class EveryFile : public testing::TestWithParam<const char*> {};

TEST_P(EveryFile, DoesNotDependOnWhoEncodesWhat) {
  const TemporaryFolder one;
  const TemporaryFolder many;
  constexpr std::int64_t kFrames = 70;
  fs::create_directory(one / "a");
  write_frames(one / GetParam(), kSmall, {}, kFrames, article_frames(kSmall));
  write_frames_by_threads(many / GetParam(), kSmall, {}, kFrames, article_frames(kSmall));
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(many / GetParam()).parent_path())) {
    ++files;
    const fs::path twin = fs::path(one / GetParam()).parent_path() / entry.path().filename();
    EXPECT_TRUE(file_contents(entry.path()) == file_contents(twin)) << twin;
  }
  EXPECT_EQ(files, std::string(GetParam()).ends_with(".png") ? kFrames : 1);
}

TEST_P(EveryFile, LeavesNoTraceWhenAbandoned) {
  const TemporaryFolder folder;
  {
    const auto output = set_up_output(folder / GetParam(), kSmall, {});
    const auto sink = output.open({1000});
    sink->append(encode_chunk(output, 0, 1000, article_frames(kSmall)));
    EXPECT_FALSE(folder.is_empty());
  }
  EXPECT_TRUE(folder.is_empty());
}

TEST_P(EveryFile, CannotBeBelowAFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a") << "not a folder";
  EXPECT_TRUE(contains(opening_error(folder / GetParam(), kSmall), folder / "a"));
  EXPECT_EQ(file_contents(folder / "a"), "not a folder");
}

TEST_P(EveryFile, NeedsAFolderThatCanBeWritten) {
  if (const auto problem = ordinary_user_problem(); !problem.empty()) GTEST_SKIP() << problem;
  const TemporaryFolder folder;
  fs::create_directory(folder / "a");
  const fs::perms search = fs::perms::owner_exec | fs::perms::others_exec;
  fs::permissions(folder.path(), search, fs::perm_options::add);
  fs::permissions(folder / "a", search);
  const OrdinaryUser user;
  EXPECT_TRUE(contains(opening_error(folder / GetParam(), kSmall), "Permission denied"));
}

TEST_P(EveryFile, RefusesAFrameOfAnotherSize) {
  const TemporaryFolder folder;
  const auto output = set_up_output(folder / GetParam(), kSmall, {});
  EXPECT_THROW(output.make_encoder()->take(Pixels(66, 36).view(), {}), MediaError);
}

TEST_P(EveryFile, RefusesAChunkOutOfOrder) {
  const TemporaryFolder folder;
  const auto output = set_up_output(folder / GetParam(), kSmall, {});
  const auto sink = output.open({1000});
  const EncodedChunk second =
      encode_chunk(output, output.frames_per_chunk, 1000, article_frames(kSmall));
  EXPECT_THROW(sink->append(second), MediaError);
}

/// Limits the size of files, as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_P(EveryFile, ReportsAFullDisk) {
  const TemporaryFolder folder;
  const std::string output = folder / GetParam();
  {
    const FileSizeLimit limit(2000);
    EXPECT_THROW(write_frames(output, kSmall, {}, 70, random_frames(kSmall)), IoError);
  }
  EXPECT_TRUE(folder.is_empty());
}

INSTANTIATE_TEST_SUITE_P(All, EveryFile,
                         testing::Values("a/out.mp4", "a/out.mov", "a/out.webm", "a/out.gif",
                                         "a/out.apng", "a/out.webp", "a/%03d.png", "a/out.y4m",
                                         "a/out.framehash"));

TEST(NullSink, KeepsNothing) {
  const auto output = set_up_output("null", kSmall, {});
  const auto sink = output.open({1000});
  EXPECT_TRUE(encode_chunk(output, 0, 100, article_frames(kSmall)).empty());
  sink->finish();
}

TEST(PngSequence, IsNumberedFromOneAndHoldsTheFrames) {
  const TemporaryFolder folder;
  const PaintFrame paint = article_frames(kSmall);
  write_frames(folder / "f%02d.png", kSmall, {}, 10, paint);
  EXPECT_FALSE(fs::exists(folder / "f00.png"));
  EXPECT_FALSE(fs::exists(folder / "f11.png"));
  for (int i = 0; i < 10; ++i) {
    const std::string name = (i < 9 ? "f0" : "f") + std::to_string(i + 1) + ".png";
    const auto png = with_png_mark(encode_png(paint(i).view()), PngMark::sequence);
    EXPECT_EQ(file_contents(folder / name), std::string(png.begin(), png.end())) << name;
  }
}

TEST(PngSequence, ReplacesFilesOnlyWhenItIsComplete) {
  const TemporaryFolder folder;
  write_frames(folder / "%d.png", kSmall, {}, 1, random_frames(kSmall));
  const std::string old = file_contents(folder / "1.png");
  const auto output = set_up_output(folder / "%d.png", kSmall, {});
  const auto sink = output.open({1000});
  sink->append(encode_chunk(output, 0, 3, article_frames(kSmall)));
  EXPECT_EQ(file_contents(folder / "1.png"), old);
  EXPECT_FALSE(fs::exists(folder / "2.png"));
  sink->finish();
  EXPECT_NE(file_contents(folder / "1.png"), old);
  EXPECT_TRUE(fs::exists(folder / "3.png"));
}

/// Files that a sequence did not make.
std::map<std::string, std::string> files_of_others() {
  const auto text = [](const Bytes& bytes) { return std::string(bytes.begin(), bytes.end()); };
  const Bytes picture = encode_png(article_frames(kSmall)(0).view());
  const Bytes frame = with_png_mark(picture, PngMark::sequence);
  return {{"a photograph", "\xff\xd8\xff\xe0"},
          {"a still", text(picture)},
          {"a difference", text(with_png_mark(picture, PngMark::difference))},
          {"the beginning of a frame", text(frame).substr(0, 60)},
          {"nothing", ""}};
}

TEST(PngSequence, HarmsNoFileOfOthersUnlessTold) {
  for (const auto& [what, bytes] : files_of_others()) {
    SCOPED_TRACE(what);
    const TemporaryFolder folder;
    const auto render = [&](std::int64_t frames, bool overwrite) {
      const auto output = set_up_output(folder / "%d.png", kSmall, {}, {}, overwrite);
      const auto sink = output.open({frames});
      sink->append(encode_chunk(output, 0, frames, article_frames(kSmall)));
      sink->finish();
      return sink->aftermath();
    };
    EXPECT_EQ(render(6, false), "");
    std::ofstream(folder / "4.png", std::ios::binary) << bytes;
    EXPECT_THROW(render(5, false), UsageError);
    EXPECT_TRUE(fs::exists(folder / "6.png"));
    EXPECT_EQ(render(2, false),
              "removed 3 pictures of an earlier run, left 1 other file that follows");
    EXPECT_EQ(file_contents(folder / "4.png"), bytes);
    EXPECT_EQ(render(3, true), "left 1 other file that follows");
    EXPECT_EQ(file_contents(folder / "4.png"), bytes);
    EXPECT_EQ(render(4, true), "replaced 1 other file");
    EXPECT_NE(file_contents(folder / "4.png"), bytes);
    EXPECT_EQ(render(4, false), "");
  }
}

TEST(PngSequence, HarmsNoFileThatCameMeanwhile) {
  const TemporaryFolder folder;
  const auto output = set_up_output(folder / "%d.png", kSmall, {});
  const auto sink = output.open({1000});
  sink->append(encode_chunk(output, 0, 3, article_frames(kSmall)));
  std::ofstream(folder / "2.png") << "mine";
  EXPECT_THROW(sink->finish(), UsageError);
  EXPECT_EQ(file_contents(folder / "2.png"), "mine");
  EXPECT_FALSE(fs::exists(folder / "1.png"));
}

TEST(PngSequence, ReplacesNothingIfOneNameIsTakenByAFolder) {
  const TemporaryFolder folder;
  write_frames(folder / "%d.png", kSmall, {}, 1, random_frames(kSmall));
  const std::string old = file_contents(folder / "1.png");
  fs::create_directory(folder / "2.png");
  EXPECT_THROW(write_frames(folder / "%d.png", kSmall, {}, 3, article_frames(kSmall)), IoError);
  EXPECT_EQ(file_contents(folder / "1.png"), old);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 2);
}

TEST(Y4m, HasTheHeaderAndThePlanesOfEveryFrame) {
  const TemporaryFolder folder;
  const VideoFormat format = {
      .width_px = 20, .height_px = 10, .frame_rate = Rational("30000/1001")};
  const PaintFrame paint = random_frames(format);
  write_frames(folder / "out.y4m", format, {}, 6, paint);

  std::string expected =
      "YUV4MPEG2 W20 H10 F30000:1001 Ip A1:1 C420mpeg2 XCOLORRANGE=LIMITED XCOLORMATRIX=BT709\n";
  for (int i = 0; i < 6; ++i) {
    std::vector<std::uint8_t> planes(300);
    convert_to_yuv420(paint(i).view(), {0, 0, 20, 10},
                      {{planes.data(), 20}, {planes.data() + 200, 10}, {planes.data() + 250, 10}});
    expected += "FRAME\n" + std::string(planes.begin(), planes.end());
  }
  EXPECT_TRUE(file_contents(folder / "out.y4m") == expected);
}

TEST(Framehash, IsWhatFfmpegSaysOfTheSameFrames) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "the command ffmpeg is not installed";
  }
  const TemporaryFolder folder;
  const VideoFormat format = {
      .width_px = 51, .height_px = 37, .frame_rate = Rational("30000/1001")};
  write_frames(folder / "%d.png", format, {}, 40, article_frames(format));
  write_frames(folder / "ours.framehash", format, {}, 40, article_frames(format));
  const std::string command =
      std::string("ffmpeg -loglevel error -nostdin -framerate 30000/1001 -i ") +
      (folder / "%d.png") + " -pix_fmt rgb24 -f framehash -hash murmur3 -fflags +bitexact " +
      (folder / "theirs.framehash");
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(file_contents(folder / "ours.framehash"), file_contents(folder / "theirs.framehash"));
}

TEST(MediaLibraries, TellTheirVersions) {
  const auto versions = media_library_versions();
  ASSERT_EQ(versions.size(), 5u);
  EXPECT_TRUE(contains(versions[1], "libavcodec "));
  EXPECT_TRUE(contains(versions[3], "giflib 5."));
  EXPECT_TRUE(contains(versions[4], "zlib 1."));
}

}  // namespace
}  // namespace piblocks
