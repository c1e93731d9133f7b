// golden: references are recorded, held to, and replaced only by approval.
#include <future>

#include "cli/cli_fixture.hpp"
#include "support/ordinary_user.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

class GoldenTest : public CliFixture {
 protected:
  void SetUp() override {
    write("scene.toml",
          "[red]\nmass = 100\n[time]\nto = 7\n[view]\nfps = 4\ntheme = 'article'\n[golden]\nsize = "
          "[160, 90]\n"
          "frames = [0, \"last\", \"#7\", \"7/2\"]\n");
  }
  CommandResult golden(const char* action, const Arguments& more = {}) const {
    return piblocks(Arguments{"golden", action, "scene.toml", "--dir", "refs"} + more);
  }
  void expect(const CommandResult& result, int exit_code, const std::string& last_line) const {
    EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
    ASSERT_FALSE(lines(result.out).empty()) << result.err;
    EXPECT_EQ(lines(result.out).back(), last_line) << result.out;
  }
  Names references() const { return names_in("refs"); }
  void edit(const std::string& file, const std::string& old, const std::string& now) const {
    std::string text = contents(file);
    write(file, text.replace(text.find(old), old.size(), now));
  }
  void make_red_heavier() const { edit("scene.toml", "mass = 100", "mass = 101"); }
};

TEST_F(GoldenTest, KeepsHashesAndTheNamedPictures) {
  expect(golden("record"), 0, "scene: recorded");
  EXPECT_EQ(references(), (Names{"scene-0.png", "scene-7_2.png", "scene-collision-7.png",
                                 "scene-last.png", "scene.framehash"}));
  EXPECT_TRUE(contains(contents("refs/scene.framehash"), "#software: cairo 1."));
  EXPECT_TRUE(contains(contents("refs/scene.framehash"), "#dimensions 0: 160x90"));
  expect(golden("check"), 0, "scene: equal");
}

TEST_F(GoldenTest, FramesAreRoundedToEvenSides) {
  for (const auto& [size, kept] : {std::pair("854x480", "480x270"),
                                   {"480x854", "270x480"},
                                   {"1366x768", "480x270"},
                                   {"1001x751", "480x360"},
                                   {"4096x2", "480x2"},
                                   {"320x180", "320x180"}}) {
    write("scene.toml",
          fmt::format("time.to = 0.1\nview.fps = 10\nview.size = '{}'\nview.theme = 'article'\n",
                      size));
    fs::remove_all(folder_ / "refs");
    expect(golden("record"), 0, "scene: recorded");
    EXPECT_TRUE(
        contains(contents("refs/scene.framehash"), fmt::format("#dimensions 0: {}\n", kept)))
        << size;
  }
}

TEST_F(GoldenTest, KeepsOtherPicturesWhereTheCommandLineSaysSo) {
  expect(golden("record", {"--frames", "1,#2"}), 0, "scene: recorded");
  EXPECT_EQ(references(), (Names{"scene-1.png", "scene-collision-2.png", "scene.framehash"}));
  expect(golden("check", {"--frames", "1,#2"}), 0, "scene: equal");
  EXPECT_EQ(golden("check").exit_code, 4);
  expect_refusal({"golden", "check", "scene.toml", "--dir", "refs", "--frames", "1,,2"},
                 "--frames: golden.frames has '': ");
}

TEST_F(GoldenTest, FindsWhatHasChangedAndChangesNothing) {
  golden("record");
  const std::string hashes = contents("refs/scene.framehash");
  const Arguments last{"still", "scene.toml", "--size", "160x90", "--at", "last", "-o"};
  output_of(last + Arguments{"before.png"});
  make_red_heavier();
  output_of(last + Arguments{"after.png"});
  const CommandResult result = golden("check", {"--diff", "d"});
  expect(result, 1, "scene: different: 16 of 28 frames differ, 3 of 4 pictures differ");
  const Names printed = lines(result.out);
  const std::string compared = lines(piblocks({"compare", "before.png", "after.png"}).out).at(0);
  EXPECT_TRUE(contains(compared, " pixels differ, largest delta ")) << compared;
  EXPECT_EQ("before.png and after" + printed.at(0).substr(std::string("scene-last").size()),
            compared);
  EXPECT_EQ(printed.at(3), "scene.framehash: frames 12 to 27 differ");
  EXPECT_EQ(printed.at(4), "scene: 'd/scene' has expected, actual and difference of 3 pictures");
  EXPECT_EQ(printed.at(5),
            "scene: 'd/scene' has the actual picture of 16 of 16 frames that differ, "
            "frame-000012-actual.png to frame-000027-actual.png; of the expected ones there are "
            "only hashes");
  EXPECT_EQ(contents("refs/scene.framehash"), hashes);
  EXPECT_EQ(names_in("d/scene").size(), 3 * 3U + 16U);
  EXPECT_TRUE(contents("d/scene/scene-last-diff.png").starts_with("\x89PNG"));
  // The picture is that of the film; sequences count from 1.
  piblocks({"render", "scene.toml", "--size", "160x90", "-o", "f/%06d.png"});
  EXPECT_EQ(piblocks({"compare", "f/000018.png", "d/scene/frame-000017-actual.png"}).exit_code, 0);
}

TEST_F(GoldenTest, ShowsAtMostSoMuch) {
  edit("scene.toml", "fps = 4", "fps = 40");
  golden("record");
  // Every second frame differs: as many ranges.
  std::string hashes;
  int number = 0;
  for (std::string line : lines(contents("refs/scene.framehash"))) {
    if (!line.starts_with('#') && ++number % 2 == 0) line.back() = line.back() == '0' ? '1' : '0';
    hashes += line + "\n";
  }
  write("refs/scene.framehash", hashes);
  const CommandResult result = golden("check", {"--diff", "d"});
  const std::string differ = std::to_string(number / 2) + " of " + std::to_string(number);
  expect(result, 1, "scene: different: " + differ + " frames differ");
  EXPECT_EQ(lines(result.out).size(), 40U + 3U);
  EXPECT_EQ(lines(result.out).at(0), "scene.framehash: frame 1 differs");
  EXPECT_EQ(lines(result.out).at(40), "… and " + std::to_string(number / 2 - 40) + " more");
  EXPECT_EQ(names_in("d/scene").size(), 40U);
}

TEST_F(GoldenTest, GoesOnWithOtherScenes) {
  const char* const scenes[] = {"equal", "none", "changed", "larger", "lacking", "damaged"};
  Arguments files;
  for (const char* const scene : scenes) {
    files.push_back(std::string(scene) + ".toml");
    write(files.back(), contents("scene.toml"));
  }
  const auto all = [&](const char* action, const Arguments& some) {
    return piblocks(Arguments{"golden", action} + some + Arguments{"--dir", "refs"});
  };
  all("record", files);
  for (const auto& entry : fs::directory_iterator(folder_ / "refs")) {
    if (entry.path().filename().string().starts_with("none")) fs::remove(entry.path());
  }
  edit("changed.toml", "mass = 100", "mass = 101");
  edit("larger.toml", "160, 90", "320, 180");
  fs::remove(folder_ / "refs/lacking-0.png");
  write("refs/damaged-0.png", "nothing");
  const CommandResult result = all("check", files);
  EXPECT_EQ(result.exit_code, 5);
  std::string last;
  for (const char* const line :
       {"equal: equal\n", "none: no references in 'refs'; 'piblocks golden record' makes them\n",
        "changed: different: 16 of 28 frames differ", "larger: different: 28 of 28 frames differ",
        "lacking-0.png: there is no reference; 'piblocks golden record' adds it\n",
        "lacking: incomplete: 1 without a reference\n", "damaged: unreadable: 1 unreadable\n"}) {
    EXPECT_TRUE(contains(result.out, line));
  }
  // One line is less severe than the next.
  const std::pair<Arguments, int> codes[] = {{{"equal.toml"}, 0},
                                             {{"equal.toml", "none.toml"}, 3},
                                             {{"none.toml", "changed.toml"}, 1},
                                             {{"changed.toml", "none.toml", "larger.toml"}, 4},
                                             {{"lacking.toml", "changed.toml"}, 4},
                                             {{"damaged.toml", "larger.toml", "none.toml"}, 5}};
  for (const auto& [some, code] : codes)
    EXPECT_EQ(all("check", some).exit_code, code) << some.back();
}

TEST_F(GoldenTest, RecordAddsWhatIsMissing) {
  write("other.toml", contents("scene.toml"));
  golden("record");
  const auto both = [&] {
    return piblocks({"golden", "record", "scene.toml", "other.toml", "--dir", "refs"});
  };
  const CommandResult result = both();
  expect(result, 0, "other: recorded");
  EXPECT_TRUE(contains(result.out, "scene: has references; 'piblocks golden check' compares"));
  for (const char* const file : {"scene-last.png", "scene.framehash"}) {
    const std::string before = contents(std::string("refs/") + file);
    fs::remove(folder_.path() / "refs" / file);
    expect(golden("check"), 4, "scene: incomplete: 1 without a reference");
    const CommandResult added = golden("record");
    EXPECT_EQ(added.out, std::string(file) + ": recorded\nscene: recorded\n");
    EXPECT_EQ(contents(std::string("refs/") + file), before);
  }
  // Not beside references of another picture.
  fs::remove(folder_ / "refs/scene-last.png");
  make_red_heavier();
  const CommandResult refused = golden("record");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_TRUE(
      contains(refused.out, "scene: not recorded, since the references that are there are not"));
  EXPECT_FALSE(fs::exists(folder_ / "refs/scene-last.png"));
  expect(golden("approve"), 0,
         "scene: replaced: 16 of 28 frames differ, 2 of 3 pictures differ, 1 without a reference");
}

TEST_F(GoldenTest, ChecksShareTheFolderOfDifferences) {
  golden("record");
  write("d", "a file");  // which an equal scene does not need
  expect(golden("check", {"--diff", "d"}), 0, "scene: equal");
  make_red_heavier();
  const CommandResult failed = golden("check", {"--diff", "d"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_TRUE(contains(failed.out, "scene: cannot write pictures: output: "));
  fs::remove(folder_ / "d");
  std::vector<std::future<CommandResult>> checks;
  for (int i = 0; i < 6; ++i) {
    checks.push_back(std::async(std::launch::async, [&] {
      return golden("check", {"--diff", "d"});
    }));
  }
  for (auto& check : checks) {
    expect(check.get(), 1, "scene: different: 16 of 28 frames differ, 3 of 4 pictures differ");
  }
  EXPECT_EQ(names_in("d/scene").size(), 3 * 3U + 16U);
  // What is equal again has none.
  golden("approve");
  write("d/scene/mine.png", "mine");
  expect(golden("check", {"--diff", "d"}), 0, "scene: equal");
  EXPECT_EQ(names_in("d/scene"), (Names{"mine.png"}));
}

TEST_F(GoldenTest, ReplacesReferencesThatCannotBeRead) {
  golden("record");
  write("refs/scene.framehash", "damaged");
  write("refs/scene-0.png", "damaged");
  expect(golden("check"), 5, "scene: unreadable: 2 unreadable");
  expect(golden("approve"), 0, "scene: replaced: 2 unreadable");
  expect(golden("check"), 0, "scene: equal");
}

TEST_F(GoldenTest, AFolderIsNoReference) {
  golden("record");
  fs::remove(folder_ / "refs/scene-last.png");
  fs::create_directory(folder_ / "refs/scene-last.png");
  for (const auto& [action, code] : {std::pair("check", 5), {"record", 1}, {"approve", 1}}) {
    const CommandResult result = golden(action);
    EXPECT_EQ(result.exit_code, code) << action;
    EXPECT_TRUE(contains(result.out + result.err, "'refs/scene-last.png': it is no file"))
        << result.out << result.err;
  }
}

TEST_F(GoldenTest, ReplacesReferencesByApprovalOnly) {
  golden("record");
  make_red_heavier();
  const CommandResult approved = golden("approve");
  expect(approved, 0, "scene: replaced: 16 of 28 frames differ, 3 of 4 pictures differ");
  EXPECT_TRUE(contains(approved.out, "scene-last.png: "));
  expect(golden("check"), 0, "scene: equal");
  expect(golden("approve"), 0, "scene: equal");
  EXPECT_EQ(references().size(), 5U);
}

TEST_F(GoldenTest, TakesNoPictureThatIsNoReference) {
  fs::create_directory(folder_ / "refs");
  write("refs/scene-last.png", "mine");
  for (const char* action : {"record", "approve"}) {
    expect_refusal({"golden", action, "scene.toml", "--dir", "refs"},
                   "'refs/scene-last.png' is there");
    EXPECT_EQ(contents("refs/scene-last.png"), "mine");
  }
}

/// Some of their pictures have the same names.
TEST_F(GoldenTest, KeepsTheReferencesOfScenesApart) {
  write("scene-collision.toml", contents("scene.toml"));
  expect_refusal({"golden", "record", "scene.toml", "scene-collision.toml", "--frames", "#7,7",
                  "--dir", "refs"},
                 "refs/scene-collision-7.png");
}

TEST_F(GoldenTest, SaysWhatElsePaintedTheReferences) {
  golden("record");
  edit("refs/scene.framehash", "cairo 1.", "cairo 9.");
  const CommandResult result = golden("check");
  expect(result, 0, "scene: equal");
  EXPECT_TRUE(contains(result.out, "scene: the references were painted by cairo 9."));
}

TEST_F(GoldenTest, SaysThatThereIsNoRoomForTemporaryFiles) {
  expect(golden("record"), 0, "scene: recorded");
  const CommandResult result = piblocks({"golden", "check", "scene.toml", "--dir", "refs"},
                                        {.environment = {"TMPDIR=/nonexistent"}});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "piblocks: golden: cannot use the folder for temporary files, $TMPDIR or /tmp: No such "
            "file or directory; set TMPDIR to one that is there\n");
}

TEST_F(GoldenTest, EndsOfLinesAreNoDifference) {
  expect(golden("record"), 0, "scene: recorded");
  std::string text;
  for (const std::string& line : lines(contents("refs/scene.framehash"))) text += line + "\r\n";
  write("refs/scene.framehash", text);
  EXPECT_EQ(golden("check").out, "scene: equal\n");
}

TEST_F(GoldenTest, ReferencesThatMayNotBeLookedAtAreNamed) {
  if (const auto problem = testing_support::ordinary_user_problem(); !problem.empty())
    GTEST_SKIP() << problem;
  fs::create_directory(folder_ / "refs");
  fs::permissions(folder_.path(), fs::perms(0755));
  fs::permissions(folder_ / "refs", fs::perms(0600));
  const std::string problem = "golden: cannot read 'refs/scene.framehash': Permission denied";
  for (const char* action : {"check", "record", "approve"}) {
    const testing_support::OrdinaryUser user;
    const CommandResult result = golden(action);
    const bool is_check = action == std::string("check");
    EXPECT_EQ(result.exit_code, is_check ? 5 : 1);
    EXPECT_TRUE(contains(is_check ? result.out : result.err, problem)) << action;
  }
  fs::permissions(folder_ / "refs", fs::perms(0700));
}

}  // namespace
}  // namespace piblocks
