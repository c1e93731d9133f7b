// golden check, record and approve of a folder of pictures: exit codes, and what becomes of files.
#include <map>

#include "cli/compare_fixture.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

constexpr const char* kSettings = "refs/piblocks-golden.txt";

/// Pictures in "out", references in "refs".
class GoldenFolderTest : public CompareFixture {
 protected:
  CommandResult golden(const std::string& action, const Arguments& more = {}) const {
    return piblocks(Arguments{"golden", action, "out"} + more + Arguments{"--against", "refs"});
  }
  int code(const std::string& action, const Arguments& more = {}) const {
    return golden(action, more).exit_code;
  }
  /// Three pictures, and references of them.
  void record(const Arguments& more = {}) const {
    for (const char* name : {"out/a.png", "out/b.png", "out/sub/c.png"}) write_grey(name, 100);
    const CommandResult result = golden("record", more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "recorded: 3 new references\n");
  }
  void expect_refused(const std::string& action, const Arguments& more,
                      const std::string& message) const {
    const auto before = files();
    const CommandResult result = golden(action, more);
    EXPECT_EQ(result.exit_code, 2) << message << result.out;
    EXPECT_TRUE(contains(result.err, message)) << result.err;
    EXPECT_EQ(files(), before);
  }
  /// What is in all files.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> found;
    for (const std::string& name : entries()) {
      if (fs::is_regular_file(folder_ / name)) found[name] = contents(name);
    }
    return found;
  }
  bool is_approved(const std::string& name) const {
    return contents("refs/" + name) == contents("out/" + name);
  }
  std::string last_line(const CommandResult& result) const {
    const auto said = lines(result.out);
    return said.empty() ? "" : said.back();
  }
};

TEST_F(GoldenFolderTest, CheckHasACodeForWhateverIsFound) {
  write_grey("out/a.png", 100);
  EXPECT_EQ(code("check"), 3) << "no folder of references";
  fs::create_directory(folder_ / "refs");
  EXPECT_EQ(code("check"), 3) << "no references";
  record();
  const auto expect_code = [&](int expected, const auto& change) {
    fs::remove_all(folder_ / "kept");
    fs::copy(folder_ / "out", folder_ / "kept", fs::copy_options::recursive);
    change();
    const auto before = files();
    EXPECT_EQ(code("check"), expected);
    EXPECT_EQ(files(), before) << "check writes nothing";
    fs::remove_all(folder_ / "out");
    fs::rename(folder_ / "kept", folder_ / "out");
    EXPECT_EQ(code("check"), 0);
  };
  expect_code(0, [] {});
  expect_code(1, [&] { write_grey("out/sub/c.png", 101); });
  expect_code(4, [&] { fs::remove(folder_ / "out/b.png"); });
  expect_code(4, [&] { write_grey("out/new.png", 1); });
  expect_code(4, [&] { write_grey("out/a.png", 100, {}, 11); });
  expect_code(5, [&] { write("out/a.png", "no picture"); });
  expect_code(5, [&] {
    fs::remove_all(folder_ / "out");
    fs::create_directory(folder_ / "out");
  });
}

TEST_F(GoldenFolderTest, RecordKeepsWhatIsThereAndAddsWhatIsNot) {
  record();
  for (const char* name : {"a.png", "b.png", "sub/c.png"}) EXPECT_TRUE(is_approved(name)) << name;
  const auto before = files();
  EXPECT_EQ(golden("record").out, "recorded: 0 new references\n");
  EXPECT_EQ(files(), before);
  write_grey("out/sub/deeper/d.png", 7);
  EXPECT_EQ(golden("record").out, "recorded: 1 new reference\n");
  EXPECT_TRUE(is_approved("sub/deeper/d.png"));
}

TEST_F(GoldenFolderTest, RecordRefusesWhereAReferenceIsNotWhatIsThere) {
  record();
  write_grey("out/new.png", 1);
  const auto expect_refusal_with = [&](int expected) {
    const auto before = files();
    const CommandResult result = golden("record");
    EXPECT_EQ(result.exit_code, expected) << result.out;
    EXPECT_TRUE(contains(result.err, "golden: nothing is recorded"));
    EXPECT_TRUE(result.out.starts_with("a.png: ")) << result.out;
    EXPECT_EQ(files(), before);
  };
  write_grey("out/a.png", 101);
  expect_refusal_with(1);
  write_grey("out/a.png", 100, {}, 11);
  expect_refusal_with(4);
  write_grey("out/a.png", 100);
  write("refs/a.png", "no picture");
  expect_refusal_with(5);
  EXPECT_EQ(code("record", {"--missing"}), 0);
  EXPECT_TRUE(is_approved("new.png"));
  EXPECT_EQ(contents("refs/a.png"), "no picture");
}

TEST_F(GoldenFolderTest, MissingAddsWhatIsNewAndReplacesNothing) {
  record();
  const std::string reference = contents("refs/a.png");
  write_grey("out/a.png", 200);
  write_grey("out/new.png", 1);
  EXPECT_EQ(golden("record", {"--missing"}).out, "recorded: 1 new reference\n");
  EXPECT_TRUE(is_approved("new.png"));
  EXPECT_EQ(contents("refs/a.png"), reference);
  EXPECT_EQ(code("check"), 1);
}

/// A reference that has no picture any more keeps nothing from being recorded.
TEST_F(GoldenFolderTest, RecordLeavesUnusedReferences) {
  record();
  fs::remove(folder_ / "out/a.png");
  write_grey("out/new.png", 1);
  EXPECT_EQ(code("record"), 0);
  EXPECT_TRUE(is_approved("new.png"));
  EXPECT_TRUE(fs::exists(folder_ / "refs/a.png"));
}

TEST_F(GoldenFolderTest, ApproveReplacesAllThatIsNotAccepted) {
  record({"--max-delta", "3"});
  write_grey("out/a.png", 200);
  write_grey("out/b.png", 102);
  write_grey("out/new.png", 1);
  write("refs/sub/c.png", "no picture");
  const CommandResult result = golden("approve");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(contains(result.out, "a.png: replaced (100 pixels differ"));
  EXPECT_TRUE(contains(result.out, "new.png: added (new)"));
  EXPECT_TRUE(contains(result.out, "sub/c.png: replaced ("));
  EXPECT_EQ(last_line(result), "approved: 2 replaced, 1 added, 0 removed");
  for (const char* name : {"a.png", "new.png", "sub/c.png"}) EXPECT_TRUE(is_approved(name)) << name;
  EXPECT_FALSE(is_approved("b.png")) << "it was accepted";
  EXPECT_EQ(code("check"), 0);
  EXPECT_EQ(golden("approve").out, "approved: 0 replaced, 0 added, 0 removed\n");
}

TEST_F(GoldenFolderTest, ApproveReplacesWhatIsNamedAndNothingElse) {
  record({"--max-delta", "3"});
  const auto change_all = [&](int level) {
    for (const char* name : {"out/a.png", "out/b.png", "out/sub/c.png"}) write_grey(name, level);
  };
  change_all(200);
  EXPECT_EQ(last_line(golden("approve", {"sub/c.png"})),
            "approved: 1 replaced, 0 added, 0 removed");
  EXPECT_TRUE(is_approved("sub/c.png"));
  EXPECT_FALSE(is_approved("a.png"));
  write("accepted.txt", "b.png\n\nsub/c.png\r\n");
  EXPECT_EQ(last_line(golden("approve", {"--accepted", "accepted.txt"})),
            "approved: 1 replaced, 0 added, 0 removed")
      << "c is equal already";
  EXPECT_TRUE(is_approved("b.png"));
  EXPECT_FALSE(is_approved("a.png"));
  change_all(201);
  EXPECT_EQ(last_line(golden("approve", {"sub/c.png"})), "approved: 1 replaced, 0 added, 0 removed")
      << "also what is accepted, if it is named";
  EXPECT_TRUE(is_approved("sub/c.png"));
  write("accepted.txt", "b.png");
  EXPECT_EQ(last_line(golden("approve", {"a.png", "--accepted", "accepted.txt"})),
            "approved: 2 replaced, 0 added, 0 removed");
}

TEST_F(GoldenFolderTest, ApproveRefusesNamesThatNoPictureHas) {
  record();
  write_grey("out/a.png", 200);
  expect_refused("approve", {"a.png", "nope.png"}, "there is no picture 'nope.png'");
  expect_refused("approve", {"c.png"}, "there is no picture 'c.png'");
  write("accepted.txt", "a.png\nnope.png\n");
  expect_refused("approve", {"--accepted", "accepted.txt"}, "there is no picture 'nope.png'");
  write("accepted.txt", "\n\n");
  expect_refused("approve", {"--accepted", "accepted.txt"}, "'accepted.txt' has no names");
  expect_refused("approve", {"--accepted", "none.txt"}, "there is no list 'none.txt'");
}

TEST_F(GoldenFolderTest, OnlyAFolderHasReferences) {
  record();
  for (const char* references : {"out/a.png", "refs/%06d.png", "%d.png"}) {
    for (const char* action : {"check", "record", "approve"}) {
      expect_refusal({"golden", action, "out", "--against", references}, "is no folder; --against");
    }
  }
}

TEST_F(GoldenFolderTest, WhatIsDoneIsSaidIfTheRestFails) {
  record();
  for (const char* name : {"out/a.png", "out/b.png", "out/sub/c.png"}) write_grey(name, 50);
  fs::remove_all(folder_ / "refs/sub");
  write("refs/sub", "in the way");
  const CommandResult result = golden("approve");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_TRUE(contains(result.out, "a.png: replaced")) << result.out;
  EXPECT_TRUE(contains(result.out, "b.png: replaced")) << result.out;
  EXPECT_TRUE(contains(result.err, "refs/sub")) << result.err;
}

TEST_F(GoldenFolderTest, ApproveRemovesReferencesOnlyIfItIsAskedTo) {
  record();
  fs::remove(folder_ / "out/a.png");
  fs::remove(folder_ / "out/sub/c.png");
  EXPECT_TRUE(contains(golden("check").out,
                       "2 references without a picture; 'golden approve --remove-unused'"));
  const CommandResult left = golden("approve");
  EXPECT_EQ(left.exit_code, 0);
  EXPECT_TRUE(contains(left.out, "a.png: left as it is (missing)"));
  EXPECT_TRUE(fs::exists(folder_ / "refs/a.png"));
  EXPECT_EQ(last_line(golden("approve", {"a.png", "--remove-unused"})),
            "approved: 0 replaced, 0 added, 1 removed");
  EXPECT_FALSE(fs::exists(folder_ / "refs/a.png"));
  EXPECT_TRUE(fs::exists(folder_ / "refs/sub/c.png")) << "it was not named";
  EXPECT_EQ(last_line(golden("approve", {"--remove-unused"})),
            "approved: 0 replaced, 0 added, 1 removed");
  EXPECT_EQ(code("check"), 0);
}

/// Whatever else can be done is done.
TEST_F(GoldenFolderTest, APictureThatCannotBeReadIsNeverApproved) {
  record();
  const std::string reference = contents("refs/a.png");
  write("out/a.png", "no picture");
  write("out/junk.png", "no picture");
  write_grey("out/new.png", 1);
  for (const auto& [action, more] :
       {std::pair<std::string, Arguments>{"record", {"--missing"}}, {"approve", {}}}) {
    fs::remove(folder_ / "refs/new.png");
    const CommandResult result = golden(action, more);
    EXPECT_EQ(result.exit_code, 5) << action << result.out;
    EXPECT_TRUE(contains(result.out, "junk.png: left as it is (")) << result.out;
    EXPECT_TRUE(contains(result.err, "golden: 2 pictures cannot be read")) << result.err;
    EXPECT_TRUE(is_approved("new.png")) << action;
    EXPECT_EQ(contents("refs/a.png"), reference) << action;
    EXPECT_FALSE(fs::exists(folder_ / "refs/junk.png")) << action;
  }
  EXPECT_EQ(code("approve", {"junk.png"}), 5);
  EXPECT_EQ(code("approve", {"new.png"}), 0) << "it alone is named";
}

TEST_F(GoldenFolderTest, PicturesMayHaveAnyName) {
  const Names names = {"a b.png", "ä.png", "x:1x1+0+0.png", "[a].png", "a'b.png"};
  for (const std::string& name : names) write_grey("out/" + name, 100);
  EXPECT_EQ(code("record"), 0);
  EXPECT_EQ(code("check"), 0);
  for (const std::string& name : names) {
    write_grey("out/" + name, 200);
    EXPECT_EQ(last_line(golden("approve", {name})), "approved: 1 replaced, 0 added, 0 removed");
    EXPECT_TRUE(is_approved(name)) << name;
  }
}

/// Also before there is one of them.
TEST_F(GoldenFolderTest, ReferencesAreNotMadeAmongThePictures) {
  write_grey("out/a.png", 100);
  const std::string whole = folder_ / "out";
  for (const auto& [pictures, references] : {std::pair<std::string, std::string>{".", "refs"},
                                             {whole, "out/refs"},
                                             {"out", whole + "/x"}}) {
    expect_refusal({"golden", "record", pictures, "--against", references},
                   "must not contain each other");
  }
  EXPECT_EQ(entries(), (Names{"out", "out/a.png"}));
}

TEST_F(GoldenFolderTest, FoldersInEachOtherAreRefused) {
  record();
  fs::create_directory_symlink("refs", folder_ / "link");
  const std::string message = "must not contain each other";
  for (const auto& [pictures, references] : {std::pair("out", "out"),
                                             {"out", "out/refs"},
                                             {"out/sub", "out"},
                                             {"out", "./out/../out/x"},
                                             {".", "refs"},
                                             {"refs", "link"},
                                             {"link/sub", "refs"}}) {
    for (const char* action : {"check", "record", "approve"}) {
      expect_refusal({"golden", action, pictures, "--against", references}, message);
    }
  }
  write_grey("outer/a.png", 100);  // begins with the name of another
  EXPECT_EQ(piblocks({"golden", "record", "outer", "--against", "outer2"}).exit_code, 0);
}

TEST_F(GoldenFolderTest, WithoutAPictureNothingIsDone) {
  fs::create_directory(folder_ / "out");
  for (const char* action : {"record", "approve"}) {
    const CommandResult result = golden(action);
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_TRUE(contains(result.err, "golden: there is no picture in 'out'")) << result.err;
    EXPECT_FALSE(fs::exists(folder_ / "refs"));
  }
  EXPECT_EQ(code("check"), 5);
  record();
  fs::remove_all(folder_ / "out");
  for (const char* action : {"check", "record", "approve"}) {
    expect_refused(action, {"--max-delta", "1"}, "'out' is no folder of pictures");
  }
  write_grey("out", 100);
  expect_refused("check", {}, "'out' is no folder of pictures");
}

TEST_F(GoldenFolderTest, OptionsAndNamesThatBelongElsewhereAreRefused) {
  record();
  for (const char* action : {"check", "record"}) {
    expect_refused(action, {"a.png"}, "unexpected argument 'a.png'");
    expect_refused(action, {"--accepted", "f"}, "unknown option '--accepted'");
    expect_refused(action, {"--remove-unused"}, "unknown option '--remove-unused'");
  }
  for (const char* action : {"check", "record", "approve"}) {
    expect_refused(action, {"--dir", "refs"}, "--dir is for scenes");
    expect_refused(action, {"--frames", "last"}, "--frames is for scenes");
  }
  expect_refused("check", {"--missing"}, "unknown option '--missing'");
}

}  // namespace
}  // namespace piblocks
