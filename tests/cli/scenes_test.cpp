// The scenes that come with the program: listed, printed, and taken by name in place of a file.
#include <filesystem>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

namespace fs = std::filesystem;

class ScenesTest : public CliFixture {
 protected:
  /// The files of the source tree, sorted.
  static std::vector<fs::path> files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(PIBLOCKS_SCENES)) {
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    EXPECT_FALSE(files.empty());
    return files;
  }
};

/// Of UTF-8.
std::size_t characters_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

TEST_F(ScenesTest, AreListedWithTheFirstLineOfTheirFiles) {
  const std::vector<std::string> listed = lines(output_of({"scenes"}));
  const std::vector<fs::path> all = files();
  ASSERT_EQ(listed.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string name = all[i].stem();
    const std::string first = lines(testing_support::file_contents(all[i])).front();
    ASSERT_TRUE(first.starts_with("# ")) << name;
    const std::string summary = first.substr(2);
    EXPECT_TRUE(listed[i].starts_with(name + ' ')) << listed[i];
    EXPECT_TRUE(listed[i].ends_with("  " + summary)) << listed[i];
    EXPECT_TRUE(summary.ends_with('.')) << name << " does not begin with a sentence";
    EXPECT_LE(characters_of(summary), 76U) << name;
  }
}

TEST_F(ScenesTest, ArePrintedAsTheirFilesAre) {
  for (const fs::path& file : files()) {
    EXPECT_EQ(output_of({"scenes", file.stem()}), testing_support::file_contents(file));
  }
}

TEST_F(ScenesTest, AreTakenByEveryCommandThatTakesASceneFile) {
  const Arguments small{"--size", "64x36"};
  EXPECT_EQ(output_of({"count", "equal-masses"}), "3\n");
  EXPECT_EQ(lines(output_of({"log", "equal-masses"})).size(), 4U);
  EXPECT_EQ(json_value(output_of({"state", "equal-masses", "--at", "last"}), {"collisions"}), "3");
  output_of(Arguments{"render", "equal-masses", "--quiet", "-o", "a.framehash"} + small);
  output_of(Arguments{"sheet", "equal-masses", "-o", "a.svg"} + small);
  output_of({"golden", "record", "equal-masses", "--dir", "golden", "--frames", "last"});
  EXPECT_EQ(entries(), (Names{"a.framehash", "a.svg", "golden", "golden/equal-masses-last.png",
                              "golden/equal-masses.framehash"}));
  EXPECT_EQ(output_of({"golden", "check", "equal-masses", "--dir", "golden", "--frames", "last"}),
            "equal-masses: equal\n");
}

TEST_F(ScenesTest, OptionsAndFilesOfTheirNamesWin) {
  EXPECT_EQ(output_of({"count", "equal-masses", "--digits", "2"}), "31\n");
  write("equal-masses", "digits = 2\n");
  EXPECT_EQ(output_of({"count", "equal-masses"}), "31\n");
  EXPECT_EQ(output_of({"count", "article"}), "314\n");
  EXPECT_TRUE(output_of({"scenes", "equal-masses"}).starts_with("# ")) << "files are not looked at";
}

TEST_F(ScenesTest, AFolderOfTheNameDoesNotCount) {
  fs::create_directory(folder_ / "equal-masses");
  EXPECT_EQ(output_of({"count", "equal-masses"}), "3\n");
}

/// No command writes over a file that it reads; a shipped scene is none.
TEST_F(ScenesTest, AnOutputMayHaveTheNameOfAShippedScene) {
  output_of({"log", "equal-masses", "-o", "equal-masses"});
  EXPECT_TRUE(contents("equal-masses").starts_with("index,"));
  write("equal-masses", "digits = 2\n");
  expect_refusal({"log", "equal-masses", "-o", "equal-masses"}, "scene file");
}

TEST_F(ScenesTest, ProblemsNameThem) {
  expect_refusal({"golden", "record", "equal-masses", "--frames", "x", "--dir", "d"}, "--frames");
  expect_refusal({"render", "storyboard", "--speed", "2", "-o", "a.mp4"},
                 "'storyboard (shipped)' is a storyboard");
}

TEST_F(ScenesTest, UnknownNamesAreAnsweredByTheNearest) {
  EXPECT_EQ(refusal({"render", "lectrue", "-o", "a.mp4"}),
            "piblocks: scene: cannot read 'lectrue': there is no such file, and no shipped scene "
            "has this name; did you mean 'lecture'? 'piblocks scenes' lists them\n");
  expect_refusal({"golden", "check", "nothing-alike", "--dir", "d"},
                 "no shipped scene has this name; 'piblocks scenes' lists them");
  EXPECT_EQ(refusal({"scenes", "lectrue"}),
            "piblocks: scenes: there is no scene 'lectrue'; did you mean 'lecture'? 'piblocks "
            "scenes' lists them\n");
  expect_refusal({"count", "lecture.toml"}, "cannot read 'lecture.toml': No such file");
}

}  // namespace
}  // namespace piblocks
