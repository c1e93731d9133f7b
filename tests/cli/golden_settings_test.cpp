// golden of a folder: the tolerance that is kept beside the references, and what painted them.
#include "cli/compare_fixture.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

/// A picture in "out" that differs from its reference in "refs" by 5 levels, in 4 of 100 pixels.
class GoldenSettingsTest : public CompareFixture {
 protected:
  CommandResult golden(const std::string& action, const Arguments& more = {}) const {
    return piblocks(Arguments{"golden", action, "out"} + more + Arguments{"--against", "refs"});
  }
  int check(const Arguments& more = {}) const { return golden("check", more).exit_code; }
  void record(const Arguments& more = {}) const {
    fs::remove_all(folder_ / "refs");
    write_grey("out/a.png", 100);
    EXPECT_EQ(golden("record", more).exit_code, 0);
    write_grey("out/a.png", 100, {{0, 0, 105}, {1, 0, 105}, {2, 0, 105}, {9, 9, 105}});
  }
  /// The kept options.
  Names settings() const {
    Names kept = lines(contents("refs/piblocks-golden.txt"));
    std::erase_if(kept, [](const std::string& line) { return line.starts_with('#'); });
    return kept;
  }
  void write_settings(const std::string& text) const { write("refs/piblocks-golden.txt", text); }
  void expect_bad_settings(const std::string& text, const std::string& message) const {
    write_settings(text);
    for (const char* action : {"check", "record", "approve"}) {
      expect_refusal({"golden", action, "out", "--against", "refs"}, message);
    }
    EXPECT_EQ(contents("refs/piblocks-golden.txt"), text);
  }
};

TEST_F(GoldenSettingsTest, TheRecordedToleranceIsThatOfLaterChecks) {
  record();
  EXPECT_EQ(settings(), Names{});
  EXPECT_EQ(check(), 1);
  for (const auto& [options, code] : {std::pair<Arguments, int>{{"--max-delta", "5"}, 0},
                                      {{"--max-delta", "4"}, 1},
                                      {{"--max-pixels", "4"}, 0},
                                      {{"--max-pixels", "3"}, 1},
                                      {{"--max-pixels", "4%"}, 0},
                                      {{"--max-pixels", "3.9%"}, 1},
                                      {{"--threshold", "0.1"}, 0},
                                      {{"--threshold", "0.01"}, 1},
                                      {{"--max-window", "2:2"}, 0},
                                      {{"--max-window", "2:1"}, 1},
                                      {{"--max-delta", "5", "--hard-delta", "4"}, 1},
                                      {{"--mask", "3x1+0+0", "--mask", "1x1+9+9"}, 0},
                                      {{"--mask", "3x1+0+0"}, 1}}) {
    record(options);
    EXPECT_EQ(check(), code) << testing::PrintToString(options);
    EXPECT_EQ(settings().size(), options.size() / 2);
  }
}

TEST_F(GoldenSettingsTest, FlagsAreKeptWithoutAValue) {
  record({"--threshold", "0.01", "--count-antialiasing", "--ignore-transparent"});
  EXPECT_EQ(settings(),
            (Names{"--threshold=0.01", "--count-antialiasing", "--ignore-transparent"}));
  EXPECT_EQ(check(), 1);
}

TEST_F(GoldenSettingsTest, TheCommandLineReplacesWhatIsKeptForOneCheck) {
  record({"--max-delta", "5"});
  const std::string kept = contents("refs/piblocks-golden.txt");
  EXPECT_EQ(check({"--max-delta", "4"}), 1);
  EXPECT_EQ(check({"--max-pixels", "3"}), 1) << "nothing is left of what is kept";
  EXPECT_EQ(check({"--threshold", "0.1"}), 0) << "nor does it contradict";
  EXPECT_EQ(contents("refs/piblocks-golden.txt"), kept);
  EXPECT_EQ(check(), 0);
}

TEST_F(GoldenSettingsTest, ApproveAndRecordKeepWhatTheyAreGiven) {
  record({"--max-delta", "5"});
  EXPECT_EQ(golden("record", {"--max-pixels", "4%"}).exit_code, 0);
  EXPECT_EQ(settings(), Names{"--max-pixels=4%"});
  EXPECT_EQ(golden("record", {"--max-pixels", "3"}).exit_code, 1);
  EXPECT_EQ(settings(), Names{"--max-pixels=4%"}) << "nothing was recorded";
  EXPECT_EQ(golden("approve", {"--threshold", "0.2"}).exit_code, 0);
  EXPECT_EQ(settings(), Names{"--threshold=0.2"});
  EXPECT_EQ(golden("approve").exit_code, 0);
  EXPECT_EQ(settings(), Names{"--threshold=0.2"});
}

TEST_F(GoldenSettingsTest, MasksAreAddedToThoseThatAreKept) {
  record({"--mask", "3x1+0+0"});
  EXPECT_EQ(check(), 1);
  EXPECT_EQ(check({"--mask", "1x1+9+9"}), 0);
  EXPECT_EQ(settings(), Names{"--mask=3x1+0+0"});
  EXPECT_EQ(golden("record", {"--mask", "a.png:1x1+9+9"}).exit_code, 0);
  EXPECT_EQ(settings(), (Names{"--mask=3x1+0+0", "--mask=a.png:1x1+9+9"}));
  EXPECT_EQ(golden("record", {"--mask", "3x1+0+0", "--max-delta", "9"}).exit_code, 0);
  EXPECT_EQ(settings(), (Names{"--max-delta=9", "--mask=3x1+0+0", "--mask=a.png:1x1+9+9"}))
      << "each once";
}

TEST_F(GoldenSettingsTest, AMaskThatIsAPictureHoldsFromAnyFolder) {
  write_grey("masks/a.png", 0, {{0, 0, 255}, {1, 0, 255}, {2, 0, 255}, {9, 9, 255}});
  record({"--mask", "a.png:masks/a.png"});
  EXPECT_EQ(settings(), Names{"--mask=a.png:../masks/a.png"});
  EXPECT_EQ(check(), 0);
  fs::rename(folder_ / "masks", folder_ / "refs/masks");
  write_settings("--mask=masks/a.png\n");
  expect_refusal({"golden", "record", "out", "--against", "refs", "--missing"},
                 "in the folder of the references");
}

TEST_F(GoldenSettingsTest, AMaskOfAPictureThatIsNotComparedIsNoMistake) {
  write_grey("out/b.png", 100);
  record({"--mask", "b.png:1x1+0+0", "--max-delta", "5"});
  fs::remove(folder_ / "out/b.png");
  EXPECT_EQ(check(), 4);
  write("out/b.png", "no picture");
  EXPECT_EQ(check(), 5);
  write_grey("out/b.png", 100, {}, 11);
  EXPECT_EQ(check(), 4);
  fs::remove(folder_ / "out/b.png");
  write_grey("out/new.png", 100);
  EXPECT_EQ(golden("record", {"--mask", "new.png:1x1+0+0"}).exit_code, 0);
  EXPECT_EQ(check(), 4) << "b.png is still missing";
}

TEST_F(GoldenSettingsTest, MasksOfAReferenceGoWithIt) {
  write_grey("out/b.png", 100);
  record({"--mask", "b.png:1x1+0+0", "--mask", "?.png:1x1+1+0", "--max-delta", "5"});
  fs::remove(folder_ / "out/b.png");
  EXPECT_EQ(golden("approve").exit_code, 0);
  EXPECT_EQ(settings().size(), 3U) << "the reference is still there";
  EXPECT_EQ(golden("approve", {"--remove-unused"}).exit_code, 0);
  EXPECT_EQ(settings(), (Names{"--max-delta=5", "--mask=?.png:1x1+1+0"}));
  EXPECT_EQ(check(), 0);
}

TEST_F(GoldenSettingsTest, ATextMayBeWrittenByHand) {
  record();
  for (const char* text : {"--max-delta=5", "\n# why: the fonts\n\n--max-delta=5\n",
                           "--max-delta=5\r\n--ignore-transparent\r\n--mask=1x1+0+0\r\n"}) {
    write_settings(text);
    EXPECT_EQ(check(), 0) << text;
  }
}

TEST_F(GoldenSettingsTest, BadLinesAreRefusedByName) {
  record();
  const std::string where = "golden: 'refs/piblocks-golden.txt' has ";
  expect_bad_settings("max-delta=5\n", where + "'max-delta=5'; it may have options such as ");
  expect_bad_settings("--report=a.html\n", where + "'--report=a.html'");
  expect_bad_settings("--max-delta 5\n", where + "'--max-delta 5'");
  expect_bad_settings("--max-delta = 5\n", where + "'--max-delta = 5'");
  expect_bad_settings(" --max-delta=5\n", where);
  expect_bad_settings("<<<<<<< HEAD\n", where);
  expect_bad_settings("--max-delta\n", where + "'--max-delta'; --max-delta has a value");
  expect_bad_settings("--ignore-transparent=no\n", "--ignore-transparent has no value");
  expect_bad_settings("--max-delta=5\n--max-delta=6\n", where + "--max-delta twice");
  expect_bad_settings("--ignore-transparent\n--ignore-transparent\n", "twice");
  expect_bad_settings("--max-delta=many\n", "--max-delta many: ");
  expect_bad_settings("--max-delta=\n", "--max-delta");
  expect_bad_settings("--mask=1x1\n", "--mask 1x1: must be WxH+X+Y");
  expect_bad_settings("--threshold=0.1\n--max-delta=5\n", "use one of them");
  expect_bad_settings("--max-delta=3000\n", "'refs/piblocks-golden.txt': --max-delta 3000");
}

/// Pictures may have gone, or have another size.
TEST_F(GoldenSettingsTest, AKeptMaskNeedNotHideAnything) {
  record();
  write_grey("mask.png", 0, {{0, 0, 255}});
  write_settings("--mask=nope.png:1x1+0+0\n--mask=1x1+999+0\n--mask=../mask.png\n");
  EXPECT_EQ(check(), 1);
  EXPECT_EQ(check({"--max-delta", "5"}), 0);
  expect_refusal({"golden", "check", "out", "--against", "refs", "--mask", "nope.png:1x1+0+0"},
                 "the mask nope.png:1x1+0+0 hides nothing");
}

TEST_F(GoldenSettingsTest, AMaskThatCannotBeKeptIsRefusedBeforeAnythingIsDone) {
  record();
  write_grey("refs/m.png", 255);
  const std::string before = contents("refs/a.png");
  for (const std::string mask : {"refs/m.png", "x\ny.png:1x1+0+0"}) {
    for (const char* action : {"record", "approve"}) {
      EXPECT_EQ(golden(action, {"--mask", mask}).exit_code, 2) << mask;
    }
  }
  EXPECT_EQ(contents("refs/a.png"), before);
}

TEST_F(GoldenSettingsTest, AMaskHoldsWhereTheReferencesAreALink) {
  fs::create_directories(folder_ / "elsewhere/deep");
  fs::create_directory_symlink("elsewhere/deep", folder_ / "refs");
  write_grey("masks/a.png", 0, {{0, 0, 255}, {1, 0, 255}, {2, 0, 255}, {9, 9, 255}});
  write_grey("out/a.png", 100);
  EXPECT_EQ(golden("record", {"--mask", "masks/a.png"}).exit_code, 0);
  write_grey("out/a.png", 100, {{0, 0, 105}, {9, 9, 105}});
  EXPECT_EQ(check(), 0);
}

/// Nobody knows what has painted references that somebody else has put there.
TEST_F(GoldenSettingsTest, VersionsAreWrittenByThoseWhoKnowThem) {
  record();
  write_settings("--max-delta=9\n");
  write_grey("out/new.png", 100);
  EXPECT_EQ(golden("record").exit_code, 0);
  EXPECT_EQ(contents("refs/piblocks-golden.txt"), "--max-delta=9\n");
  EXPECT_EQ(golden("approve", {"a.png"}).exit_code, 0);
  EXPECT_EQ(contents("refs/piblocks-golden.txt"), "--max-delta=9\n");
  EXPECT_EQ(golden("approve").exit_code, 0);
  EXPECT_TRUE(contents("refs/piblocks-golden.txt").starts_with("# recorded with cairo "));
}

TEST_F(GoldenSettingsTest, CommentsStay) {
  record({"--max-delta", "2"});
  write_settings("# ours, by hand\n\n--max-delta=5\n");
  EXPECT_EQ(golden("approve").exit_code, 0);
  EXPECT_TRUE(contains(contents("refs/piblocks-golden.txt"), "# ours, by hand\n--max-delta=5\n"));
}

TEST_F(GoldenSettingsTest, ANameWithBracketsIsAlsoItself) {
  write_grey("out/t[1].png", 100);
  record();
  write_grey("out/a.png", 100);
  write_grey("out/t[1].png", 200);
  EXPECT_EQ(check({"--mask", "t[1].png:9x10+0+0", "--mask", "t[[]1].png:1x9+9+0"}), 1);
  EXPECT_EQ(check({"--mask", "t[1].png:9x10+0+0", "--max-pixels", "10"}), 0);
}

/// The others may still be what the earlier machine has drawn.
TEST_F(GoldenSettingsTest, ApprovingSomePicturesKeepsTheVersionsOfTheOthers) {
  record();
  write_settings("# recorded with cairo 9.9\n");
  EXPECT_EQ(golden("approve", {"a.png"}).exit_code, 0);
  EXPECT_EQ(lines(contents("refs/piblocks-golden.txt")), Names{"# recorded with cairo 9.9"});
}

TEST_F(GoldenSettingsTest, AnotherPainterIsNamedWhereSomethingDiffers) {
  record();
  const std::string ours = lines(contents("refs/piblocks-golden.txt")).front();
  ASSERT_TRUE(ours.starts_with("# recorded with cairo ")) << ours;
  const std::string note = "the references were recorded with cairo 9.9; this machine has cairo ";
  EXPECT_FALSE(contains(golden("check").out, "the references were recorded"));
  write_settings("# recorded with cairo 9.9\n");
  EXPECT_TRUE(contains(golden("check").out, note));
  EXPECT_FALSE(contains(golden("check", {"--max-delta", "5"}).out, "recorded with"));
  EXPECT_EQ(golden("check", {"--quiet"}).out, "");
  EXPECT_EQ(golden("approve").exit_code, 0);
  EXPECT_EQ(lines(contents("refs/piblocks-golden.txt")), Names{ours});
}

}  // namespace
}  // namespace piblocks
