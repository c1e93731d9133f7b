// Films, stills, sheets, pages, bundles and sound of bodies.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "cli/bodies_fixture.hpp"

namespace piblocks {
namespace {

TEST_F(BodiesCli, PagesAndBundlesSayWhatMovesAndHowOftenItMeets) {
  output_of({"render", "endless.toml", "--size", "64x64", "--fps", "5", "--quiet", "--to", "3",
             "-o", "a.html"});
  const std::string page = contents("a.html");
  EXPECT_TRUE(contains(page, "3 blocks move along a line without friction, with 2 walls. All"));
  EXPECT_FALSE(contains(page, "after which there are no more"));
  output_of({"render", "meeting.toml", "--size", "64x64", "--fps", "5", "--quiet", "--hold-end",
             "1", "-o", "a.mp4", "--bundle", "talk"});
  const std::string captions = contents("talk/captions.vtt");
  EXPECT_TRUE(captions.starts_with("WEBVTT")) << captions;
  EXPECT_TRUE(contains(captions, "after which there are no more"));
}

class BodiesRender : public BodiesCli, public testing::WithParamInterface<const char*> {};

TEST_P(BodiesRender, BytesDoNotDependOnJobsNorOnParts) {
  const Arguments render{"render", GetParam(), "--quiet", "--size", "640x360",
                         "--fps",  "5",        "--sound", "-o"};
  output_of(render + Arguments{"a.mp4", "--jobs", "1"});
  output_of(render + Arguments{"b.mp4", "--jobs", "2"});
  ASSERT_GT(contents("a.mp4").size(), 5000U);
  EXPECT_TRUE(contents("a.mp4") == contents("b.mp4"));
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    output_of(render + Arguments{"c.mp4", "--part", part});
  }
  output_of({"join", "--quiet", "c.mp4.part-2-of-3", "c.mp4.part-3-of-3", "c.mp4.part-1-of-3", "-o",
             "c.mp4"});
  EXPECT_TRUE(contents("a.mp4") == contents("c.mp4"));
  for (const char* name : {"1.framehash", "2.framehash"}) {
    output_of({"render", GetParam(), "--quiet", "--size", "640x360", "--fps", "5", "--no-sound",
               "-o", name, "--jobs", std::string(1, *name)});
  }
  EXPECT_TRUE(contents("1.framehash") == contents("2.framehash"));
}

TEST_P(BodiesRender, AStillIsTheFrameOfItsInstant) {
  const Arguments small{"--size", "640x360", "--fps", "2"};
  output_of(Arguments{"render", GetParam(), "--quiet", "--no-sound", "-o", "%d.png"} + small);
  output_of(Arguments{"still", GetParam(), "--at", "0", "-o", "still.png"} + small);
  output_of({"compare", "still.png", "1.png"});
}

TEST_P(BodiesRender, StillsAndSheetsAreOfEveryKind) {
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    const Arguments still{"still", GetParam(), "--at", "1", "--size", "640x360", "-o", name};
    output_of(still);
    const std::string first = contents(name);
    output_of(still);
    EXPECT_TRUE(contents(name) == first) << name << " differs the second time";
    output_of({"sheet", GetParam(), "--frames", "4", "-o", std::string("sheet-") + name});
    EXPECT_GT(contents(std::string("sheet-") + name).size(), first.size()) << name;
  }
  EXPECT_TRUE(contents("a.png").starts_with("\x89PNG"));
  EXPECT_TRUE(contains(contents("a.svg"), "<svg"));
  EXPECT_TRUE(contents("a.pdf").starts_with("%PDF-"));
}

INSTANTIATE_TEST_SUITE_P(Shipped, BodiesRender, testing::Values("superball", "gas"),
                         [](const auto& one) { return std::string(one.param); });

/// Nothing is heard before the first collision, and each is heard from its time on.
TEST_F(BodiesCli, CollisionsAreHeard) {
  for (const char* scene : {"three-blocks", "billiard", "superball"}) {
    output_of({"render", scene, "--quiet", "--fps", "10", "-o", "a.wav"});
    const std::string wav = contents("a.wav");
    const auto number = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, wav.data() + at, sizeof value);
      return value;
    };
    ASSERT_TRUE(wav.starts_with("RIFF"));
    const std::size_t format = wav.find("fmt ");
    const std::size_t rate = number(format + 12);
    const std::size_t row_bytes = number(format + 20) & 0xffff;
    ASSERT_GT(row_bytes, 0U);
    const std::size_t data = wav.find("data") + 8;
    const auto is_silent = [&](double from_s, double to_s) {
      const auto begin = static_cast<std::size_t>(from_s * double(rate)) * row_bytes;
      const auto end = static_cast<std::size_t>(to_s * double(rate)) * row_bytes;
      const std::string part = wav.substr(data + begin, end - begin);
      return part.find_first_not_of('\0') == std::string::npos;
    };
    const auto rows = lines(output_of({"log", scene}));
    const double first = std::stod(split(rows.at(1), ',')[1]);
    EXPECT_TRUE(is_silent(0, first - 0.01)) << scene;
    const double end = double(wav.size() - data) / double(rate * row_bytes) - 0.01;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double time = std::stod(split(rows[i], ',')[1]);
      if (time > end) break;
      EXPECT_FALSE(is_silent(time, time + 0.01)) << scene << ", " << rows[i];
    }
  }
}

TEST_F(BodiesCli, AStoryboardMayHaveBodies) {
  write("story.toml", R"(
view.size = [640, 360]
view.fps = 10
view.theme = "lecture"
sound.on = true
[[part]]
digits = 1
time.to = 3
[[part]]
fade = 0.5
time.to = 4
show.title = "Two blocks"
show.panels = ["time"]
[[part.body]]
position = 0
velocity = 1
[[part.body]]
position = 3
mass = 2
[[part]]
time.to = 2
box.x = [0, 9]
box.y = [0, 3]
compare = [
  { body = [{ position = [1.1, 1.1], velocity = [1, 0] }, { position = [5, 1.5] }] },
  { body = [{ position = [1.1, 1.1], velocity = [3, 0] }, { position = [5, 1.5] }] },
]
)");
  const Arguments render{"render", "story.toml", "--quiet", "-o"};
  output_of(render + Arguments{"a.mp4", "--jobs", "1"});
  output_of(render + Arguments{"b.mp4", "--jobs", "2"});
  EXPECT_TRUE(contents("a.mp4") == contents("b.mp4"));
  for (const char* part : {"1/2", "2/2"}) output_of(render + Arguments{"c.mp4", "--part", part});
  output_of({"join", "--quiet", "c.mp4.part-1-of-2", "c.mp4.part-2-of-2", "-o", "c.mp4"});
  EXPECT_TRUE(contents("a.mp4") == contents("c.mp4"));
  output_of(render + Arguments{"%03d.png", "--no-sound"});
  const std::vector<std::string> all = entries();
  const auto frames = std::ranges::count_if(
      all, [](const std::string& name) { return name.size() == 7 && name.ends_with(".png"); });
  EXPECT_EQ(frames, 85) << "five belong to two parts";
  output_of({"still", "story.toml", "--at", "8", "-o", "still.png"});
  output_of({"compare", "still.png", "081.png"});
}

}  // namespace
}  // namespace piblocks
