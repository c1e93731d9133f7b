// render: every kind of output, and that it depends on nothing but the scene.
#include <fmt/format.h>

#include <thread>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using RenderTest = CliFixture;

constexpr std::size_t kFrame_bytes = 6 + 64 * 36 * 3 / 2;  // "FRAME\n" and 4:2:0

std::size_t y4m_frames(const std::string& y4m) {
  const std::size_t header = y4m.find('\n') + 1;
  EXPECT_EQ((y4m.size() - header) % kFrame_bytes, 0u);
  return (y4m.size() - header) / kFrame_bytes;
}

/// So many frames at 10 frames per second.
Arguments frames(int count) {
  return {"render", "--quiet", "--size", "64x36",
          "--fps",  "10",      "--to",   fmt::format("{}/10", count)};
}

TEST_F(RenderTest, WritesEveryKind) {
  const Arguments two = frames(2);
  EXPECT_EQ(output_of(two + Arguments{"-o", "a.mp4"}), "");
  EXPECT_EQ(output_of(two + Arguments{"-o", "new/folder/%06d.png"}), "");
  EXPECT_EQ(output_of(two + Arguments{"-o", "a.y4m"}), "");
  EXPECT_EQ(output_of(two + Arguments{"-o", "a.framehash"}), "");
  EXPECT_EQ(output_of(two + Arguments{"-o", "null"}), "");
  for (const char* output : {"a.mov", "a.webm", "a.gif", "a.apng", "a.webp"}) {
    EXPECT_EQ(output_of(two + Arguments{"-o", output}), "") << output;
  }
  EXPECT_EQ(entries(),
            (Names{"a.apng", "a.framehash", "a.gif", "a.mov", "a.mp4", "a.webm", "a.webp", "a.y4m",
                   "new", "new/folder", "new/folder/000001.png", "new/folder/000002.png"}));
  EXPECT_EQ(contents("a.mp4").substr(4, 4), "ftyp");
  EXPECT_TRUE(contents("new/folder/000001.png").starts_with("\x89PNG"));
  EXPECT_TRUE(contents("a.y4m").starts_with("YUV4MPEG2 W64 H36 F10:1 "));
  EXPECT_EQ(y4m_frames(contents("a.y4m")), 2u);
  EXPECT_TRUE(contains(contents("a.framehash"), "#dimensions 0: 64x36"));
}

TEST_F(RenderTest, AGifHasNoMoreFramesThanItCanShow) {
  const auto gif_of = [&](const char* fps) {
    const CommandResult result =
        piblocks({"render", "--size", "64x36", "--to", "1", "--fps", fps, "-o", "a.gif"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result;
  };
  const CommandResult fifty = gif_of("50");
  EXPECT_FALSE(contains(fifty.err, "note"));
  const std::string bytes = contents("a.gif");
  for (const char* fps : {"60", "60000/1001", "120", "1000"}) {
    SCOPED_TRACE(fps);
    EXPECT_TRUE(
        contains(gif_of(fps).err, "piblocks: note: 'a.gif' shows at most 50 frames a second"));
    EXPECT_TRUE(contents("a.gif") == bytes);
  }
}

TEST_F(RenderTest, NamesPlayersThatPromiseLessThanTheVideoNeeds) {
  const auto errors_of = [&](const char* size, const char* fps, const Arguments& more) {
    const Arguments arguments{"render", "--size", size, "--fps", fps, "--to", "1/10"};
    const CommandResult result = piblocks(arguments + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  const std::string note =
      "piblocks: note: H.264 of 3840x2160 at level 5.2: Windows, and PowerPoint with it, promises "
      "to play no more than 4096x2304 at level 5.1; for these use a smaller --size or fewer "
      "--fps\n";
  for (const char* name : {"a.mp4", "a.mov"}) {
    EXPECT_TRUE(errors_of("3840x2160", "60", {"-o", name}).ends_with(note)) << name;
    EXPECT_FALSE(contains(errors_of("3840x2160", "30", {"-o", name}), "note")) << name;
  }
  EXPECT_TRUE(contains(errors_of("64x2306", "30", {"-o", "a.mp4"}), "H.264 of 64x2306 at level"));
  EXPECT_EQ(errors_of("3840x2160", "60", {"--quiet", "-o", "a.mp4"}), "");
  EXPECT_FALSE(contains(errors_of("3840x2160", "60", {"-o", "a.apng"}), "note"));
}

TEST_F(RenderTest, StandardOutputGetsTheBytesOfTheFile) {
  output_of(frames(3) + Arguments{"-o", "a.y4m"});
  EXPECT_EQ(output_of(frames(3) + Arguments{"-o", "-"}), contents("a.y4m"));
}

TEST_F(RenderTest, ADestinationSetsWhatIsNotSaidOtherwise) {
  const auto header = [&](const Arguments& more) {
    output_of(Arguments{"render", "--quiet", "--to", "0.1", "-o", "%d.png"} + more);
    const std::string png = contents("1.png");
    const auto big_endian = [&](std::size_t at) {
      return (static_cast<unsigned char>(png.at(at + 2)) << 8) +
             static_cast<unsigned char>(png.at(at + 3));
    };
    int files = 0;
    for (const std::string& name : entries()) {
      if (!name.ends_with(".png")) continue;
      ++files;
      std::filesystem::remove(folder_ / name);
    }
    const bool has_alpha = png.at(25) == 6;
    return fmt::format("{}x{}, {} frames{}", big_endian(16), big_endian(20), files,
                       has_alpha ? ", transparent" : "");
  };
  EXPECT_EQ(header({}), "1920x1080, 6 frames");
  EXPECT_EQ(header({"--for", "beamer"}), "1280x720, 3 frames");
  EXPECT_EQ(header({"--for", "editor"}), "1920x1080, 6 frames, transparent");
  EXPECT_EQ(header({"--for", "editor", "--opaque", "--fps", "10"}), "1920x1080, 1 frames");
  EXPECT_EQ(header({"--for", "beamer", "--size", "65x37", "--transparent"}),
            "65x37, 3 frames, transparent");
  write("scene.toml", "[view]\nsize = [64, 36]\nfps = 10\nbackground = 'transparent'\n");
  EXPECT_EQ(header({"scene.toml"}), "64x36, 1 frames, transparent");
  EXPECT_EQ(header({"scene.toml", "--for", "beamer"}), "1280x720, 3 frames, transparent")
      << "a destination wins over the file";
}

TEST_F(RenderTest, LastsUntilAWhileAfterTheLastCollision) {
  // One digit: the last of three collisions is at 5.
  const auto count = [&](const Arguments& times) {
    return y4m_frames(output_of(Arguments{"render", "--quiet", "--size", "64x36", "--digits", "1",
                                          "--fps", "2", "-o", "-"} +
                                times));
  };
  EXPECT_EQ(count({}), 14u) << "0, 1/2, ... 13/2";
  EXPECT_EQ(count({"--to", "last"}), 11u);
  EXPECT_EQ(count({"--to", "last+1/2"}), 12u);
  EXPECT_EQ(count({"--to", "5"}), 10u) << "the end itself is not shown";
  EXPECT_EQ(count({"--from", "-1", "--to", "1"}), 4u);
  EXPECT_EQ(count({"--to", "5", "--speed", "1/2"}), 20u);
}

TEST_F(RenderTest, ReadsTheSceneFileAndLetsOptionsWin) {
  write("scene.toml", "[view]\nsize = [128, 72]\nfps = 5\n[time]\nto = 1\n");
  const std::string from_file = output_of({"render", "scene.toml", "--quiet", "-o", "-"});
  EXPECT_TRUE(from_file.starts_with("YUV4MPEG2 W128 H72 F5:1 "));
  const std::string smaller = output_of({"render", "scene.toml", "--quiet", "--size", "64x36",
                                         "--fps", "30000/1001", "--to", "0.1", "-o", "-"});
  EXPECT_TRUE(smaller.starts_with("YUV4MPEG2 W64 H36 F30000:1001 "));
  EXPECT_EQ(y4m_frames(smaller), 3u);
}

TEST_F(RenderTest, WritesNothingThatFlashesTooMuch) {
  const Arguments small = {"render", "--quiet", "--size", "320x180", "--max-flashes", "3"};
  output_of(small + Arguments{"-o", "usual.mp4"});
  // Blue bounces as large as the frame.
  write("close.toml", "[view]\nx = [-1, 1]\ny = [-0.5, 0.5]\n");
  const Arguments close = small + Arguments{"close.toml", "--from", "3", "--to", "4"};
  expect_refusal(close + Arguments{"-o", "close.mp4"}, "more than 3 times within a second");
  expect_refusal(close + Arguments{"--part", "2/2", "-o", "close.mp4"}, "--slow-motion");
  output_of(close + Arguments{"--speed", "1/50", "-o", "close.mp4"});
}

TEST_F(RenderTest, EncoderOptionsReachTheEncoder) {
  const Arguments two = frames(2);
  output_of(two + Arguments{"--crf", "1", "-o", "best.mp4"});
  output_of(two + Arguments{"--crf", "51", "-o", "worst.mp4"});
  EXPECT_GT(contents("best.mp4").size(), contents("worst.mp4").size());
  output_of(two + Arguments{"--preset", "ultrafast", "--encoder", "libx264", "-o", "fast.mp4"});
  EXPECT_NE(contents("fast.mp4"), contents("best.mp4"));
  output_of(two + Arguments{"--encoder", "builtin", "-o", "builtin.mp4"});
  output_of(two + Arguments{"-o", "default.mp4"});
  EXPECT_EQ(contents("builtin.mp4"), contents("default.mp4"));
  EXPECT_NE(contents("builtin.mp4"), contents("fast.mp4"));
  output_of(two + Arguments{"--smallest", "-o", "smallest.mp4"});
  EXPECT_TRUE(contains(contents("smallest.mp4"), "x264 - core"));
}

TEST_F(RenderTest, ManyJobsTakeNoMoreMemoryThanIsWorthIt) {
  if (!testing_support::kTellsMemory) GTEST_SKIP() << "a sanitizer has memory of its own";
  if (std::thread::hardware_concurrency() > 8) GTEST_SKIP() << "each processor has its worker";
  // A canvas of 38 MB, and planes of 14 MB, for each of 64 workers would be 3.3 GB.
  const CommandResult result =
      piblocks({"render", "--size", "4096x2304", "--to", "1", "--jobs", "64", "-o", "-"},
               {.out_file = "/dev/null"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LT(result.max_memory_KiB, 800 * 1024);
}

TEST_F(RenderTest, SaysWhatItWroteUnlessQuiet) {
  const Arguments render{"render", "--size", "64x36", "--fps", "10", "-o", "null"};
  const CommandResult two = piblocks(render + Arguments{"--to", "0.2"});
  EXPECT_EQ(two.exit_code, 0);
  EXPECT_TRUE(two.err.starts_with("null: 2 frames in ")) << two.err;
  EXPECT_EQ(lines(two.err).size(), 1u);
  EXPECT_TRUE(piblocks(render + Arguments{"--to", "0.1"}).err.starts_with("null: 1 frame in "));
  EXPECT_EQ(piblocks(render + Arguments{"--to", "0.2", "--quiet"}).err, "");
}

}  // namespace
}  // namespace piblocks
