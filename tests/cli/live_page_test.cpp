// page: the live page, opened on a scene. The page here is made up,
// beside a copy of the program; that the program in the real one works is checked by tests/web.
#include <piblocks/version.hpp>

#include <iomanip>
#include <sstream>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

const std::string kStart = "<script id=\"opened-scene\" type=\"application/json\">";
const std::string kEnd = "</script>";

std::string made_by(const std::string& version) {
  return "<meta name=\"generator\" content=\"piblocks " + version + "\">\n";
}

const std::string kBefore = "<!DOCTYPE html>\n" + made_by(kVersion);
const std::string kMark = kStart + "null" + kEnd;
// As long as the real one, with bytes of all kinds.
const std::string kAfter = "\n<script>const x = null;</script>\n" + std::string(4 << 20, 'x') +
                           std::string("\0\xff\r\n\x1a", 5) + "</html>\n";
const std::string kPage = kBefore + kMark + kAfter;

/// The code of four hexadecimal digits, in UTF-8; the program writes only ASCII so.
std::string character(const std::string& digits) {
  const int code = std::stoi(digits, nullptr, 16);
  EXPECT_LT(code, 0x80);
  return std::string(1, static_cast<char>(code));
}

/// The string that a JSON text is, read to the letter of RFC 8259. Fails on anything else.
std::string json_string(const std::string& json) {
  const std::string letters = "\"\\/bfnrt";
  const std::string meanings = "\"\\/\b\f\n\r\t";
  std::string text;
  EXPECT_TRUE(json.size() >= 2 && json.front() == '"' && json.back() == '"') << json;
  for (std::size_t at = 1; at + 1 < json.size(); ++at) {
    EXPECT_TRUE(static_cast<unsigned char>(json[at]) >= 0x20 && json[at] != '"') << json;
    if (json[at] != '\\') {
      text += json[at];
      continue;
    }
    const char letter = json.at(++at);
    if (letter == 'u') {
      text += character(json.substr(at + 1, 4));
      at += 4;
    } else {
      EXPECT_NE(letters.find(letter), std::string::npos) << json;
      text += meanings.at(letters.find(letter));
    }
  }
  return text;
}

class LivePageTest : public CliFixture {
 protected:
  static void SetUpTestSuite() {
    prefix_ = std::make_unique<TemporaryFolder>();
    fs::create_directories(bin());
    fs::copy_file(PIBLOCKS_PROGRAM, bin() / "piblocks");
  }
  static void TearDownTestSuite() { prefix_.reset(); }

  void SetUp() override {
    if (fs::exists(PIBLOCKS_INSTALLED_PAGE)) {
      GTEST_SKIP() << PIBLOCKS_INSTALLED_PAGE << " is installed, so that no page is missing";
    }
    for (const char* const left : {"share", "release/CMakeCache.txt", "../out"}) {
      fs::remove_all(bin().parent_path() / left);
    }
    place(kPage);
  }

  static fs::path tree() { return prefix_->path() / "tree"; }
  // As deep as a build folder in its source tree.
  static fs::path bin() { return tree() / "build" / "release"; }
  static fs::path page_file() { return bin() / "../share/piblocks/piblocks.html"; }

  static void place(const std::string& page, const fs::path& file = page_file()) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << page;
  }

  CommandResult run(const Arguments& arguments) const {
    return piblocks(arguments, {.program = bin() / "piblocks"});
  }
  /// The page that the program writes, when all is well.
  std::string written(const Arguments& arguments) const {
    const CommandResult result = run(Arguments{"page", "-o", "a.html"} + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out + result.err, "");
    return contents("a.html");
  }
  /// The text of the scene that a page opens; the rest of the page is as it was.
  static std::string scene_in(const std::string& page) {
    EXPECT_TRUE(page.starts_with(kBefore + kStart));
    EXPECT_TRUE(page.ends_with(kEnd + kAfter));
    const std::size_t begin = kBefore.size() + kStart.size();
    const std::string json = page.substr(begin, page.size() - begin - (kEnd + kAfter).size());
    EXPECT_EQ(json.find('<'), std::string::npos) << json;
    const std::string key = "{\"text\":";
    EXPECT_TRUE(json.starts_with(key) && json.ends_with("}")) << json;
    return json_string(json.substr(key.size(), json.size() - key.size() - 1));
  }
  /// What the page opens, as a file of the folder.
  std::string opened(const Arguments& arguments) const {
    write("opened.toml", scene_in(written(arguments)));
    return "opened.toml";
  }
  void expect_failure(const Arguments& arguments, int exit_code, const std::string& message) const {
    write("a.html", "what was there");
    const Names before = entries();
    const CommandResult result = run(Arguments{"page", "-o", "a.html"} + arguments);
    EXPECT_EQ(result.exit_code, exit_code);
    EXPECT_TRUE(contains(result.err, message));
    EXPECT_EQ(lines(result.err).size(), 1U) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(contents("a.html"), "what was there");
    EXPECT_EQ(entries(), before);
  }

  static inline std::unique_ptr<TemporaryFolder> prefix_;
};

TEST_F(LivePageTest, OpensTheSceneWithAllOptions) {
  const Arguments system{"--digits", "4", "--base", "12"};
  const Arguments look{"--size", "640x360", "--theme", "dark", "--shutter", "1/2", "--no-hits"};
  const std::string file = opened(system + look);
  EXPECT_EQ(output_of({"count", file}), output_of(Arguments{"count"} + system));
  const Arguments at{"--at", "0,3.5,turn-0.3,last,#17"};
  EXPECT_EQ(output_of(Arguments{"state", file} + at), output_of(Arguments{"state"} + system + at));
  const Arguments still{"still", "--at", "turn", "-o"};
  output_of(still + Arguments{"a.png", file});
  output_of(still + Arguments{"b.png"} + system + look);
  EXPECT_TRUE(contents("a.png") == contents("b.png"));
}

TEST_F(LivePageTest, OpensThePacingAndTheSound) {
  const Arguments options{"--from",   "1/3",    "--slow-motion", "turn-0.1:turn+0.1:20",
                          "--freeze", "#7:1/2", "--loop",        "--sound",
                          "--size",   "64x36"};
  const std::string file = opened(options);
  output_of({"render", "--quiet", file, "-o", "a.mp4"});
  output_of(Arguments{"render", "--quiet", "-o", "b.mp4"} + options);
  EXPECT_TRUE(contents("a.mp4") == contents("b.mp4"));
}

/// The same film, to the last byte.
TEST_F(LivePageTest, OpensShippedScenesAndStoryboards) {
  for (const char* const scene : {"lecture", "storyboard", "gas", "real-blocks", "three-blocks"}) {
    const std::string file = opened({scene});
    const Arguments render{"render", "--quiet", "--size",     "640x360",
                           "--fps",  "2",       "--no-sound", "-o"};
    output_of(render + Arguments{"a.framehash", scene});
    output_of(render + Arguments{"b.framehash", file});
    EXPECT_EQ(contents("a.framehash"), contents("b.framehash")) << scene;
    EXPECT_GT(lines(contents("a.framehash")).size(), 3U);
  }
}

TEST_F(LivePageTest, OpensASceneFile) {
  write("scene.toml", "mass-ratio = \"1/3\"\nblue.position = 2\n");
  EXPECT_EQ(output_of({"state", opened({"scene.toml"}), "--at", "0,last"}),
            output_of({"state", "scene.toml", "--at", "0,last"}));
}

TEST_F(LivePageTest, NoTextEndsTheElement) {
  const std::string title = "</script><!--<script>\"\\ \xc2\xa0 \xcf\x80 &amp;";
  const std::string page = written({"--title", title});
  write("opened.toml", scene_in(page));
  const Arguments still{"still", "--size", "640x360", "--at", "1", "-o"};
  output_of(still + Arguments{"a.png", "opened.toml"});
  output_of(still + Arguments{"b.png", "--title", title});
  output_of(still + Arguments{"c.png"});
  EXPECT_TRUE(contents("a.png") == contents("b.png"));
  EXPECT_FALSE(contents("a.png") == contents("c.png"));
}

TEST_F(LivePageTest, GoesToStandardOutput) {
  const CommandResult result = run({"page", "--digits", "2", "-o", "-"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(result.out == written({"--digits", "2"}));
  EXPECT_EQ(entries(), Names{"a.html"});
}

TEST_F(LivePageTest, RefusesWrongUsage) {
  const CommandResult named = run({"page", "-o", "new/a.mp4"});
  EXPECT_EQ(named.exit_code, 2);
  EXPECT_EQ(
      named.err,
      "piblocks: output: cannot write a page to 'new/a.mp4'; use NAME.html, or - for standard "
      "output\n");
  expect_failure({"--digits", "0"}, 2, "piblocks: --digits: ");
  expect_failure({"nothing.toml"}, 2, "piblocks: scene: cannot read 'nothing.toml'");
  expect_failure({"--digits", "3", "--mass-ratio", "4"}, 2, "both set the mass of red");
  EXPECT_EQ(run({"page"}).exit_code, 2);
  write("story.toml", "[[part]]\ncard = \"a\"\nseconds = 1\n[[part]]\nfade = 2\n");
  expect_failure({"story.toml"}, 2, "fade");
}

/// What only the film finds: these refusals are those of `render`, word for word.
TEST_F(LivePageTest, RefusesTheScenesThatRenderRefuses) {
  for (const Arguments& scene :
       {Arguments{"--freeze", "#400:1"}, Arguments{"--to", "-1"}, Arguments{"--panels", "nothing"},
        Arguments{"--from", "#1000"}, Arguments{"lecture", "--size", "64x36"}}) {
    const CommandResult rendered = piblocks(Arguments{"render", "-o", "a.mp4"} + scene);
    ASSERT_EQ(rendered.exit_code, 2) << scene.front();
    expect_failure(scene, 2, rendered.err);
  }
}

TEST_F(LivePageTest, RefusesALogo) {
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "logo.png"});
  expect_failure({"--logo", "logo.png"}, 2,
                 "piblocks: show.logo: a page cannot read the file 'logo.png'; leave the logo out");
  write("story.toml", "[[part]]\ndigits = 1\n[[part]]\nshow.logo = \"logo.png\"\n");
  expect_failure({"story.toml"}, 2, "show.logo: a page cannot read the file");
}

TEST_F(LivePageTest, RefusesAPageOfAnotherVersion) {
  place("<!DOCTYPE html>\n" + made_by("0.0.1") + kMark + kAfter);
  expect_failure({}, 1,
                 "share/piblocks/piblocks.html': it is of version 0.0.1, not " +
                     std::string(kVersion) + "; '");
  // A longer number is another version.
  place("<!DOCTYPE html>\n" + made_by(std::string(kVersion) + "1") + kMark + kAfter);
  expect_failure({}, 1, "it is of version " + std::string(kVersion) + "1, not ");
}

TEST_F(LivePageTest, RefusesAPageWithoutItsMarks) {
  place("<!DOCTYPE html>\n" + kMark + kAfter);
  expect_failure({}, 1, "piblocks.html': it has no '<meta name=\"generator\"");
  place(kBefore + made_by(kVersion) + kMark + kAfter);
  expect_failure({}, 1, "piblocks.html': it has several '<meta name=\"generator\"");
  place(kBefore + kAfter);
  expect_failure({}, 1, "piblocks.html': it has no '<script id=\"opened-scene\"");
  place(kPage + kMark);
  expect_failure({}, 1, "piblocks.html': it has several '<script id=\"opened-scene\"");
  place(kBefore + kStart + "nullify" + kEnd + kAfter);
  expect_failure({}, 1, "piblocks.html': it opens a scene already");
  place(kBefore + kStart + "{\"text\":\"\"}" + kEnd + kAfter);
  expect_failure({}, 1, "piblocks.html': it opens a scene already");
  place("");
  expect_failure({}, 1, "piblocks.html': it has no '<meta");
}

TEST_F(LivePageTest, SaysWhereItLookedForThePage) {
  fs::remove(page_file());
  const std::string beside = fs::canonical(bin()).parent_path() / "share/piblocks/piblocks.html";
  expect_failure({}, 1,
                 "piblocks: page: cannot read the live page; install one of this version, or build "
                 "it by scripts/web: '" +
                     beside + "': No such file or directory; '" + PIBLOCKS_INSTALLED_PAGE +
                     "': No such file or directory\n");
  fs::create_directory(page_file());
  expect_failure({}, 1, "piblocks.html': Is a directory; '");
}

/// A program that lies where it was built finds what scripts/web has made of the same sources.
TEST_F(LivePageTest, IsFoundFromTheBuildFolder) {
  if (std::string(PIBLOCKS_PAGE_FROM_BUILD) != "../../out/piblocks.html") {
    GTEST_SKIP() << "the build folder is " << PIBLOCKS_PAGE_FROM_BUILD;
  }
  fs::remove(page_file());
  place(kPage, tree() / "out" / "piblocks.html");
  expect_failure({}, 1, "No such file");
  std::ofstream(bin() / "CMakeCache.txt") << "";
  EXPECT_EQ(scene_in(written({"--digits", "2"})), "red.mass = 100\nview.shutter = \"1/2\"\n");
  place(kBefore, tree() / "out" / "piblocks.html");
  expect_failure({}, 1, "/tree/out/piblocks.html': it has no '<script");
}

TEST_F(LivePageTest, IsNotWrittenOverWhatItIsMadeOf) {
  const std::string message = "the live page";
  fs::create_hard_link(page_file(), folder_ / "hard.html");
  fs::create_symlink(page_file(), folder_ / "soft.html");
  write("scene.html", "digits = 2\n");
  for (const auto& [output, what] : {std::pair<std::string, std::string>{page_file(), message},
                                     {"hard.html", message},
                                     {"soft.html", message},
                                     {"scene.html", "the scene file"}}) {
    const CommandResult result = run({"page", "./scene.html", "-o", output});
    EXPECT_EQ(result.exit_code, 2) << output;
    EXPECT_TRUE(contains(result.err, what));
  }
  EXPECT_TRUE(testing_support::file_contents(page_file()) == kPage);
  EXPECT_EQ(contents("scene.html"), "digits = 2\n");
}

TEST_F(LivePageTest, AFullDiskLeavesNothing) {
  const CommandResult result =
      piblocks({"page", "-o", "-"}, {.out_file = "/dev/full", .program = bin() / "piblocks"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err, "No space left"));
  EXPECT_EQ(entries(), Names{});
}

}  // namespace
}  // namespace piblocks
