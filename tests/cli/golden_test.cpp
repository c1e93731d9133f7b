// golden: references are recorded, held to, and replaced only by approval.
#include "cli/cli_fixture.hpp"
#include "support/ordinary_user.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class GoldenTest : public CliFixture {
 protected:
  void SetUp() override {
    write("scene.toml",
          "[red]\nmass = 100\n[view]\nfps = 4\n[golden]\nsize = [160, 90]\n"
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
  Names references() const {
    Names names;
    for (const auto& entry : fs::directory_iterator(folder_ / "refs")) {
      names.push_back(entry.path().filename());
    }
    std::ranges::sort(names);
    return names;
  }
  void make_red_heavier() const {
    std::string text = contents("scene.toml");
    text.replace(text.find("mass = 100"), 10, "mass = 101");
    write("scene.toml", text);
  }
};

TEST_F(GoldenTest, KeepsHashesAndTheNamedPictures) {
  expect(golden("record"), 0, "scene: recorded");
  EXPECT_EQ(references(), (Names{"scene-0.png", "scene-7_2.png", "scene-collision-7.png",
                                 "scene-last.png", "scene.framehash"}));
  EXPECT_NE(contents("refs/scene.framehash").find("#software: cairo 1."), std::string::npos);
  EXPECT_NE(contents("refs/scene.framehash").find("#dimensions 0: 160x90"), std::string::npos);
  expect(golden("check"), 0, "scene: equal");
}

TEST_F(GoldenTest, KeepsOtherPicturesWhereTheCommandLineSaysSo) {
  expect(golden("record", {"--frames", "1,#2"}), 0, "scene: recorded");
  EXPECT_EQ(references(), (Names{"scene-1.png", "scene-collision-2.png", "scene.framehash"}));
  expect(golden("check", {"--frames", "1,#2"}), 0, "scene: equal");
  EXPECT_EQ(golden("check").exit_code, 3);
  const CommandResult wrong = golden("check", {"--frames", "1,,2"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("--frames: golden.frames has '': "), std::string::npos) << wrong.err;
}

TEST_F(GoldenTest, FindsWhatHasChangedAndChangesNothing) {
  golden("record");
  const std::string hashes = contents("refs/scene.framehash");
  make_red_heavier();
  const CommandResult result = golden("check", {"--diff", "d"});
  expect(result, 1, "scene: different");
  EXPECT_NE(result.out.find("scene.framehash: frame "), std::string::npos);
  EXPECT_NE(result.out.find("scene-last.png: scene-last.png: "), std::string::npos);
  EXPECT_EQ(contents("refs/scene.framehash"), hashes);
  EXPECT_TRUE(contents("d/scene-last/000000.png").starts_with("\x89PNG"));
}

TEST_F(GoldenTest, ReplacesReferencesByApprovalOnly) {
  golden("record");
  make_red_heavier();
  const CommandResult again = golden("record");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("golden approve"), std::string::npos);
  const CommandResult approved = golden("approve");
  expect(approved, 0, "scene: replaced");
  EXPECT_NE(approved.out.find("scene-last.png: "), std::string::npos);
  expect(golden("check"), 0, "scene: equal");
  expect(golden("approve"), 0, "scene: equal");
  EXPECT_EQ(references().size(), 5U);
}

TEST_F(GoldenTest, MissesReferencesWithACodeOfItsOwn) {
  const CommandResult none = golden("check");
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("there is no reference 'refs/scene.framehash'"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "refs"));
  golden("record");
  fs::remove(folder_ / "refs/scene-last.png");
  EXPECT_EQ(golden("check").exit_code, 3);
}

TEST_F(GoldenTest, TakesNoPictureThatIsNoReference) {
  fs::create_directory(folder_ / "refs");
  write("refs/scene-last.png", "mine");
  for (const char* action : {"record", "approve"}) {
    const CommandResult result = golden(action);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("'refs/scene-last.png' is there"), std::string::npos) << result.err;
    EXPECT_EQ(references(), (Names{"scene-last.png"}));
    EXPECT_EQ(contents("refs/scene-last.png"), "mine");
  }
}

/// Some of their pictures have the same names.
TEST_F(GoldenTest, KeepsTheReferencesOfScenesApart) {
  write("scene-collision.toml", contents("scene.toml"));
  const CommandResult result = piblocks({"golden", "record", "scene.toml", "scene-collision.toml",
                                         "--frames", "#7,7", "--dir", "refs"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("refs/scene-collision-7.png"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder_ / "refs"));
}

TEST_F(GoldenTest, SaysWhatElsePaintedTheReferences) {
  golden("record");
  std::string text = contents("refs/scene.framehash");
  text.replace(text.find("cairo 1."), 8, "cairo 9.");
  write("refs/scene.framehash", text);
  const CommandResult result = golden("check");
  expect(result, 0, "scene: equal");
  EXPECT_NE(result.out.find("scene: the references were painted by cairo 9."), std::string::npos);
}

// The hashes of scene "scene-0" and the first picture of "scene" have names that differ by their
// endings alone.
TEST_F(GoldenTest, PicturesOfDifferencesAreNotLostToAnotherScenesHashes) {
  write("scene-0.toml", contents("scene.toml"));
  const auto both = [&](const char* action, const Arguments& more = {}) {
    return piblocks(Arguments{"golden", action, "scene.toml", "scene-0.toml", "--dir", "refs"} +
                    more);
  };
  expect(both("record"), 0, "scene-0: recorded");
  fs::copy_file(folder_ / "refs/scene-last.png", folder_ / "refs/scene-0.png",
                fs::copy_options::overwrite_existing);
  for (int run = 0; run < 2; ++run) {
    expect(both("check", {"--diff", "diff"}), 1, "scene-0: equal");
    EXPECT_TRUE(fs::exists(folder_ / "diff/scene-0/000000.png"));
  }
  EXPECT_FALSE(fs::exists(folder_ / "diff/scene"));
}

TEST_F(GoldenTest, SaysThatThereIsNoRoomForTemporaryFiles) {
  expect(golden("record"), 0, "scene: recorded");
  const CommandResult result = testing_support::run_command(
      {"golden", "check", "scene.toml", "--dir", "refs"},
      {.folder = folder_.path(), .environment = {"TMPDIR=/nonexistent"}});
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
  for (const char* action : {"check", "record", "approve"}) {
    const testing_support::OrdinaryUser user;
    const CommandResult result = golden(action);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err,
              "piblocks: golden: cannot read 'refs/scene.framehash': Permission denied\n");
  }
  fs::permissions(folder_ / "refs", fs::perms(0700));
}

}  // namespace
}  // namespace piblocks
