// render --bundle DIR: a video and what a lecture needs beside it, all or nothing.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using BundleTest = CliFixture;

const Arguments kRender{"render", "--quiet", "--size", "64x36", "--fps", "30", "-o", "pi.mp4"};
const Names kFiles{"talk",           "talk/alt.txt", "talk/captions.srt", "talk/captions.vtt",
                   "talk/latex.tex", "talk/pi.mp4",  "talk/poster.png",   "talk/reveal.html"};

struct Cue {
  double begin_s;
  double end_s;
  std::string text;
};

/// "01:02:03.004"
double seconds(const std::string& text) {
  EXPECT_EQ(text.size(), 12U) << text;
  return 3600 * std::stod(text.substr(0, 2)) + 60 * std::stod(text.substr(3, 2)) +
         std::stod(text.substr(6));
}

std::vector<Cue> cues_of(const std::string& captions) {
  const std::vector<std::string> all = lines(captions);
  EXPECT_EQ(all.at(0), "WEBVTT");
  EXPECT_EQ(all.at(1), "");
  std::vector<Cue> cues;
  for (std::size_t i = 2; i < all.size(); i += 3) {
    EXPECT_EQ(all[i].substr(12, 5), " --> ") << all[i];
    cues.push_back({seconds(all[i].substr(0, 12)), seconds(all[i].substr(17)), all.at(i + 1)});
    EXPECT_TRUE(i + 2 >= all.size() || all[i + 2].empty());
  }
  return cues;
}

/// The number a caption starts with.
std::string number_of(const std::string& caption) {
  std::string number = caption.substr(0, caption.find(' '));
  std::erase(number, ',');
  return number == "No" ? "0" : number;
}

TEST_F(BundleTest, HoldsTheVideoAndAllThatGoesWithIt) {
  output_of(kRender + Arguments{"--bundle", "talk"});
  EXPECT_EQ(entries(), kFiles);
  output_of(kRender);
  EXPECT_TRUE(contents("talk/pi.mp4") == contents("pi.mp4"));
  EXPECT_EQ(contents("talk/alt.txt"),
            "Two blocks slide along a line without friction: the inner one, beside a wall on the "
            "left, has mass 1, the outer one mass 10,000. At time 0 the inner one rests and the "
            "outer one slides towards the wall. All collisions are elastic, and a counter reaches "
            "314 collisions, after which there are no more. The count has the first 3 digits of π, "
            "3.14.\n");
  output_of(kRender + Arguments{"--base", "2", "--bundle", "binary"});
  EXPECT_TRUE(
      contents("binary/alt.txt")
          .ends_with("314 collisions, after which there are no more. It is written in base 2: "
                     "100111010.\n"))
      << "314 is digits of π in base 10 alone";
}

TEST_F(BundleTest, ThePosterIsTheLastFrameOrTheOneAskedFor) {
  output_of(kRender + Arguments{"--bundle", "talk"});
  Arguments frames = kRender;
  frames.back() = "all/%06d.png";
  output_of(frames);
  Names pictures = entries();
  std::erase_if(pictures, [](const std::string& name) { return !name.starts_with("all/"); });
  output_of({"compare", "talk/poster.png", pictures.back()});
  output_of(kRender + Arguments{"--bundle", "talk", "--poster", "#7"});
  output_of({"still", "--size", "64x36", "--fps", "30", "--at", "#7", "-o", "7.png"});
  EXPECT_TRUE(contents("talk/poster.png") == contents("7.png"));
}

/// A run with a diagram ends at 1.5 s, the last run at 2.5 s.
TEST_F(BundleTest, ThePosterOfAStoryboardIsOfItsLastDiagram) {
  const auto poster_is_at = [this](const std::string& panels, const std::string& second) {
    write("story.toml",
          "view = { size = '640x360', fps = 2 }\n[[part]]\ndigits = 1\ntime.to = 1.5\n" + panels +
              "[[part]]\ndigits = 2\ntime.to = 1\n[[part]]\nfade = 0.5\n" + "card = 'end'\n");
    output_of({"render", "story.toml", "--quiet", "--bundle", "talk", "-o", "pi.mp4"});
    output_of({"still", "story.toml", "--at", second, "-o", "expected.png"});
    return contents("talk/poster.png") == contents("expected.png");
  };
  EXPECT_TRUE(poster_is_at("show.panels = ['velocity']\n", "1"));
  EXPECT_FALSE(poster_is_at("", "1"));
  EXPECT_EQ(contents("talk/captions.vtt"),
            "WEBVTT\n\n00:00:00.000 --> 00:00:02.500\nNo collision yet\n\n00:00:02.500 --> "
            "00:00:04.000\nend\n");
  EXPECT_TRUE(contents("talk/alt.txt").ends_with(" Part 3. “end”.\n"));
  output_of(
      {"render", "story.toml", "--quiet", "--poster", "1", "--bundle", "talk", "-o", "pi.mp4"});
  output_of({"still", "story.toml", "--at", "1", "-o", "expected.png"});
  EXPECT_TRUE(contents("talk/poster.png") == contents("expected.png"));
}

/// At each cue's first frame, and not before, so many collisions have happened.
TEST_F(BundleTest, CaptionsSayWhatTheFramesCount) {
  output_of(kRender + Arguments{"--digits", "5", "--bundle", "talk"});
  const std::vector<Cue> cues = cues_of(contents("talk/captions.vtt"));
  ASSERT_GE(cues.size(), 5U);
  EXPECT_EQ(cues.front().begin_s, 0);
  EXPECT_EQ(cues.front().text, "No collision yet");
  EXPECT_EQ(cues.at(1).text, "1 collision or more");
  EXPECT_EQ(cues.back().text, "31,415 collisions: π = 3.1415…");
  for (std::size_t i = 1; i < cues.size(); ++i) {
    EXPECT_EQ(cues[i - 1].end_s, cues[i].begin_s);
    EXPECT_GT(cues[i].begin_s, cues[i - 1].begin_s);
    const long frame = std::lround(std::floor(cues[i].begin_s * 30 + 1e-6));
    const auto count_at = [&](long number) {
      const std::string state =
          output_of({"state", "--digits", "5", "--at", std::to_string(number) + "/30"});
      return std::stol(json_value(state, {"collisions"}));
    };
    const long milestone = std::stol(number_of(cues[i].text));
    EXPECT_GE(count_at(frame), milestone) << cues[i].text;
    EXPECT_LT(count_at(frame - 1), count_at(frame)) << cues[i].text;
  }
}

TEST_F(BundleTest, CaptionsFollowTheSchedule) {
  const auto first_s = [this](const Arguments& pacing) {
    output_of(kRender + Arguments{"--digits", "1", "--bundle", "talk"} + pacing);
    return cues_of(contents("talk/captions.vtt")).at(1).begin_s;
  };
  EXPECT_NEAR(first_s({}), 2, 0.001);
  EXPECT_NEAR(first_s({"--speed", "1/2"}), 4, 0.001);
  EXPECT_NEAR(first_s({"--hold-start", "3"}), 5, 0.001);
  EXPECT_NEAR(first_s({"--slow-motion", "1:3:4", "--ease", "0"}), 5, 0.001);
}

TEST_F(BundleTest, CaptionsOfALoopGoBack) {
  output_of(kRender + Arguments{"--digits", "1", "--loop", "--bundle", "talk"});
  std::vector<std::string> texts;
  for (const Cue& cue : cues_of(contents("talk/captions.vtt"))) texts.push_back(cue.text);
  const Names expected{"No collision yet", "1 collision", "2 collisions",    "3 collisions: π = 3…",
                       "2 collisions",     "1 collision", "No collision yet"};
  EXPECT_EQ(texts, expected);
}

TEST_F(BundleTest, SnippetsNameTheFiles) {
  output_of(kRender + Arguments{"--bundle", "talk"});
  const std::string latex = contents("talk/latex.tex");
  EXPECT_TRUE(contains(latex, "keepaspectratio]{poster.png}}{pi.mp4}"));
  EXPECT_EQ(std::ranges::count(latex, '{'), std::ranges::count(latex, '}'));
  const std::string reveal = contents("talk/reveal.html");
  for (const char* piece : {"poster=\"poster.png\"", "src=\"pi.mp4\"", "r-stretch",
                            "src=\"data:text/vtt;base64,V0VCVlRU", "aria-label=\"Two blocks"}) {
    EXPECT_TRUE(contains(reveal, piece));
  }
}

/// SubRip has numbers, and a comma before the milliseconds.
TEST_F(BundleTest, SubtitlesAreTheCaptions) {
  Arguments render = kRender;
  render.at(3) = "320x180";
  output_of(render + Arguments{"--title", "Left & right <", "--bundle", "talk"});
  std::string expected;
  int number = 0;
  for (std::string line : lines(contents("talk/captions.vtt"))) {
    if (line == "WEBVTT") continue;
    if (line.empty()) {
      if (number++ > 0) expected += '\n';
      expected += std::to_string(number) + "\n";
      continue;
    }
    if (contains(line, " --> ")) line[8] = line[25] = ',';
    for (const auto& [mark, letter] : {std::pair{"&amp;", "&"}, {"&lt;", "<"}}) {
      if (const auto at = line.find(mark); at != line.npos)
        line.replace(at, std::strlen(mark), letter);
    }
    expected += line + "\n";
  }
  EXPECT_GT(number, 2);
  EXPECT_TRUE(contains(expected, "Left & right <"));
  EXPECT_EQ(contents("talk/captions.srt"), expected);
}

/// A track of the MP4, as ffmpeg reads it.
TEST_F(BundleTest, CaptionsInsideAreThoseBeside) {
  Arguments render = kRender;
  render.at(3) = "320x180";
  for (const Arguments& more : {Arguments{}, Arguments{"--sound"}}) {
    output_of(render + more + Arguments{"--captions", "inside", "--overwrite", "--bundle", "talk"});
    // Without tags for the font.
    const std::string inside = shell("ffmpeg -nostdin -v error -i talk/" + render.back() +
                                     " -map 0:s -f srt - | sed -E 's/<[^>]*>//g'");
    EXPECT_EQ(inside, contents("talk/captions.srt") + "\n");
  }
  EXPECT_EQ(refusal({"render", "-o", "a.gif", "--captions", "inside"}),
            "piblocks: output: 'a.gif' has no captions inside; leave them out or write one of: "
            "*.mp4\n");
  EXPECT_EQ(refusal({"render", "-o", "a.mp4", "--captions", "inside", "--crf", "20"}),
            "piblocks: output: captions inside an MP4 need the encoder builtin; leave out either "
            "--captions or crf, preset, encoder and smallest\n");
  EXPECT_EQ(refusal({"render", "-o", "a.mp4", "--captions", "inside", "--part", "1/2"}),
            "piblocks: part: parts have no captions inside; leave --captions or --part out\n");
  EXPECT_EQ(refusal({"render", "-o", "a.mp4", "--captions", "beside"}),
            "piblocks: --captions beside: must be inside; --bundle writes captions beside the "
            "video\n");
}

TEST_F(BundleTest, LeavesOtherFilesAlone) {
  output_of(kRender + Arguments{"--bundle", "talk"});
  write("talk/notes.txt", "mine");
  write("talk/alt.txt", "old");
  output_of(kRender + Arguments{"--bundle", "talk"});
  EXPECT_EQ(contents("talk/notes.txt"), "mine");
  EXPECT_NE(contents("talk/alt.txt"), "old") << "of the earlier bundle";
  EXPECT_EQ(entries().size(), kFiles.size() + 1);
}

TEST_F(BundleTest, IsAllOrNothing) {
  std::filesystem::create_directories(folder_ / "talk/reveal.html");
  write("talk/alt.txt", "old");
  EXPECT_EQ(refusal(kRender + Arguments{"--overwrite", "--bundle", "talk"}, 1),
            "piblocks: output: cannot replace 'talk/reveal.html': Is a directory\n");
  EXPECT_EQ(contents("talk/alt.txt"), "old");
}

TEST_F(BundleTest, SaysWhereAFilmEndsThatIsBeforeTimeZero) {
  write("scene.toml",
        "digits = 1\nblue = { position = 3, velocity = 1 }\nred.velocity = '1/3'\n"
        "time = { from = -20, to = -10 }\n");
  output_of(Arguments{"render", "scene.toml", "--quiet", "--size", "64x36", "--bundle", "talk",
                      "-o", "pi.mp4"});
  EXPECT_TRUE(contents("talk/alt.txt")
                  .ends_with("a counter reaches -2: 2 collisions are to go until time 0.\n"))
      << contents("talk/alt.txt");
}

/// A page has to step through times; captions are in seconds of the video.
TEST_F(BundleTest, HoldsTimesThatAPageCannot) {
  write("scene.toml", "red.velocity = '-1e-300'\n");
  output_of(Arguments{"render", "scene.toml", "--quiet", "--size", "64x36", "--duration", "1",
                      "--bundle", "talk", "-o", "pi.mp4"});
  EXPECT_EQ(number_of(cues_of(contents("talk/captions.vtt")).back().text), "314");
}

/// Three shots with a cut and a fade between them.
constexpr const char* kThreeShots = R"(
view = { size = "128x72", fps = 20 }
sound.on = true
[[part]]
card = "One"
seconds = 0.5
[[part]]
digits = 1
time.from = 1
time.to = 4
[[part]]
fade = 0.5
digits = 2
time.to = 3
)";
const Arguments kStoryBundle{"render", "story.toml", "--quiet", "--bundle", "talk", "-o", "pi.mp4"};
const Names kShotFiles{"chapters.vtt", "impress.fodp", "pi-01.mp4", "pi-01.png",
                       "pi-02.mp4",    "pi-02.png",    "pi-03.mp4", "pi-03.png"};

constexpr std::size_t kFrames = 120;

class ShotsTest : public BundleTest {
 protected:
  ShotsTest() { write("story.toml", kThreeShots); }
  Names found_shot_files() const {
    Names names = names_in("talk");
    std::erase_if(names, [](const auto& name) {
      return std::ranges::find(kFiles, "talk/" + name) != kFiles.end();
    });
    return names;
  }
};

/// The whole film has key frames at other places, so samples differ by what H.264 loses.
TEST_F(ShotsTest, AreVideosOfTheFilmsFrames) {
  constexpr double kLeast_db = 38;
  output_of(kStoryBundle);
  EXPECT_EQ(found_shot_files(), kShotFiles);
  output_of({"render", "story.toml", "--quiet", "-o", "pi.mp4"});
  EXPECT_TRUE(contents("talk/pi.mp4") == contents("pi.mp4"));
  std::size_t begin = 0;
  for (const std::string name : {"talk/pi-01", "talk/pi-02", "talk/pi-03"}) {
    const Names frames = lines(
        shell("ffmpeg -loglevel error -i " + name +
              ".mp4 -i pi.mp4 -lavfi '[1:v]trim=start_frame=" + std::to_string(begin) +
              ",setpts=PTS-STARTPTS[film];[0:v][film]psnr=stats_file=-:shortest=1' -f null -"));
    for (const std::string& frame : frames) {
      const double found_db = std::stod(frame.substr(frame.find("psnr_avg:") + 9));
      EXPECT_GT(found_db, kLeast_db) << name << " " << frame;
    }
    begin += frames.size();
    output_of({"still", "story.toml", "--at", std::to_string(begin - 1) + "/20", "-o", "last.png"});
    EXPECT_TRUE(contents(name + ".png") == contents("last.png")) << name;
    EXPECT_TRUE(contains(contents(name + ".mp4"), "mp4a")) << "it has sound";
  }
  EXPECT_EQ(begin, kFrames);
}

TEST_F(ShotsTest, DependOnNoThread) {
  output_of(kStoryBundle + Arguments{"--jobs", "1"});
  std::vector<std::string> files;
  for (const std::string& name : kShotFiles) files.push_back(contents("talk/" + name));
  output_of(kStoryBundle + Arguments{"--jobs", "3"});
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_TRUE(contents("talk/" + kShotFiles[i]) == files[i]) << kShotFiles[i];
  }
}

/// A frame counts when it is in the film and in its shot.
TEST_F(ShotsTest, AreCountedOnce) {
  const CommandResult result =
      piblocks({"render", "story.toml", "--bundle", "talk", "-o", "pi.mp4"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(contains(result.err, "talk/pi.mp4: " + std::to_string(kFrames) + " frames in "))
      << result.err;
}

TEST_F(ShotsTest, ReplaceThoseOfAnEarlierBundleAlone) {
  std::filesystem::create_directory(folder_ / "talk");
  write("talk/pi-02.mp4", "mine");
  expect_refusal(kStoryBundle, "bundle: 'talk/pi-02.mp4' is there, but not from an earlier bundle");
  std::filesystem::rename(folder_ / "talk/pi-02.mp4", folder_ / "talk/pi-04.mp4");
  output_of(kStoryBundle);
  write("talk/pi-02.mp4", "old");
  output_of(kStoryBundle);
  EXPECT_NE(contents("talk/pi-02.mp4"), "old");
  const std::string story = kThreeShots;
  write("story.toml", story.substr(0, story.rfind("[[part]]")));
  output_of(kStoryBundle);
  EXPECT_EQ(found_shot_files(), (Names{"chapters.vtt", "impress.fodp", "pi-01.mp4", "pi-01.png",
                                       "pi-02.mp4", "pi-02.png", "pi-04.mp4"}));
  output_of(kRender + Arguments{"--bundle", "talk"});
  EXPECT_EQ(found_shot_files(), (Names{"pi-04.mp4"})) << "a scene has no shots";
  EXPECT_EQ(contents("talk/pi-04.mp4"), "mine");
  write("talk/chapters.vtt", "mine");
  write("story.toml", story);
  expect_refusal(kStoryBundle, "bundle: 'talk/chapters.vtt' is there");
}

TEST_F(ShotsTest, OfOnePartAreTheFilm) {
  write("story.toml", "view = { size = '64x36', fps = 20 }\n[[part]]\ndigits = 1\ntime.to = 1\n");
  output_of(kStoryBundle);
  EXPECT_EQ(entries(), (Names{"story.toml"} + kFiles));
}

TEST_F(ShotsTest, LeaveNothingBehindWhenInterrupted) {
  write("story.toml", std::string(kThreeShots) + "[[part]]\ndigits = 2\ntime.to = 600\n");
  RunningCommand command(kStoryBundle, {.folder = folder_.path()});
  ASSERT_TRUE(wait_until([&] {
    const Names names = entries();
    return std::ranges::any_of(names, [](const auto& name) { return name.ends_with("pi-04.png"); });
  }));
  command.send(SIGINT);
  EXPECT_EQ(command.wait().exit_code, -SIGINT);
  EXPECT_EQ(entries(), (Names{"story.toml"}));
}

TEST_F(BundleTest, RefusesWhatItCannotBe) {
  const Arguments bundle{"render", "--quiet", "--bundle", "talk", "-o"};
  expect_refusal(bundle + Arguments{"new/pi.mp4"}, "'new/pi.mp4' is no name for the video in it");
  expect_refusal(bundle + Arguments{"pi.gif"}, "'pi.gif' is no name for the video in it");
  expect_refusal(bundle + Arguments{"a b.mp4"}, "'a b.mp4' is no name for the video in it");
  expect_refusal(bundle + Arguments{"pi.mp4", "--part", "1/2"}, "a bundle has no parts");
  expect_refusal(bundle + Arguments{"pi.mp4", "--poster", "#9999"}, "9999");
  expect_refusal(bundle + Arguments{"pi.mp4", "--transparent"},
                 "bundle: 'pi.mp4' cannot be transparent");
  expect_refusal({"render", "--poster", "3", "-o", "pi.mp4"}, "--poster is for a bundle");
}

}  // namespace
}  // namespace piblocks
