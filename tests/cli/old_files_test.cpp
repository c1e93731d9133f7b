// What was there before a run: which files it replaces, and which it leaves alone.
#include <csignal>
#include <map>
#include <string>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

const Arguments kSmall{"render", "--quiet", "--size", "64x36", "--fps", "10"};

class OldFilesTest : public CliFixture {
 protected:
  void render(const std::string& output, const std::string& to = "0.5") const {
    output_of(kSmall + Arguments{"--to", to, "-o", output});
  }
  bool is_png(const std::string& name) const { return contents(name).starts_with("\x89PNG"); }
};

TEST_F(OldFilesTest, OfAnotherProgramStayWhateverTheirNames) {
  fs::create_directory(folder_ / "a.mp4.unfinished-backup");
  write("a.mp4.unfinished-backup/file", "mine");
  write("a.mp4.unfinished-abcdef", "mine");
  fs::create_directory(folder_ / "frames.unfinished-backup");
  write("frames.unfinished-backup/file", "mine");
  const Names before = entries();
  render("a.mp4");
  fs::remove(folder_ / "a.mp4");
  EXPECT_EQ(entries(), before);
  render("%d.png", "0.1");
  fs::remove(folder_ / "1.png");
  EXPECT_EQ(entries(), before);
}

class KeptTest : public CliFixture, public testing::WithParamInterface<const char*> {};

TEST_P(KeptTest, PermissionsAndLinksOfTheReplacedFile) {
  Arguments arguments = split(GetParam(), ' ');
  const std::string name = arguments.back();
  fs::create_directory(folder_ / "there");
  write("there/file", "old");
  fs::permissions(folder_ / "there/file", fs::perms(0600));
  fs::create_symlink("there/file", folder_ / name);
  output_of(arguments);
  EXPECT_TRUE(fs::is_symlink(folder_ / name));
  EXPECT_EQ(fs::status(folder_ / "there/file").permissions(), fs::perms(0600));
  EXPECT_NE(contents("there/file"), "old");
  EXPECT_EQ(entries().size(), 3U);
}
INSTANTIATE_TEST_SUITE_P(Outputs, KeptTest,
                         testing::Values("render --quiet --size 64x36 --to 0.1 -o a.mp4",
                                         "render --quiet --size 64x36 --to 0.1 -o a.y4m",
                                         "render --quiet --size 64x36 --to 0.1 -o a.html",
                                         "still --size 64x36 --at 1 -o a.png",
                                         "sheet --size 64x36 -o a.pdf", "log --limit 2 -o a.csv"));

TEST_F(OldFilesTest, OfALongerSequenceGoWithIt) {
  render("f/%03d.png", "1");
  const std::size_t longer = entries().size();
  for (const char* other : {"f/000.png", "f/4.png", "f/0004.png", "f/004.jpg", "f/x004.png"}) {
    write(other, "mine");
  }
  write("f/099.png", "behind a gap");
  render("f/%03d.png", "0.3");
  EXPECT_GE(longer, 10U);
  EXPECT_EQ(entries(), (Names{"f", "f/000.png", "f/0004.png", "f/001.png", "f/002.png", "f/003.png",
                              "f/004.jpg", "f/099.png", "f/4.png", "f/x004.png"}));
}

TEST_F(OldFilesTest, AfterAPartOfALongerSequenceStay) {
  render("%d.png");
  Names all = entries();
  ASSERT_EQ(all.size(), 5U);
  std::map<std::string, std::string> before;
  for (const std::string& name : all) before[name] = contents(name);
  const Arguments part = kSmall + Arguments{"--theme", "dark", "--to", "0.2", "-o", "%d.png"};
  output_of(part + Arguments{"--start-number", "3"});
  EXPECT_EQ(entries(), all);
  for (const std::string& name : all) {
    EXPECT_EQ(contents(name) == before[name], name != "3.png" && name != "4.png") << name;
  }
  output_of(part + Arguments{"--start-number", "0"});
  output_of(part + Arguments{"--start-number", "999999998"});
  for (const char* name : {"0.png", "999999998.png", "999999999.png"}) EXPECT_TRUE(is_png(name));
  write("700.png", "mine");
  const CommandResult refused = piblocks(part + Arguments{"--start-number", "699"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "'700.png' is there")) << refused.err;
  EXPECT_FALSE(fs::exists(folder_ / "699.png"));
  for (const char* number : {"1", "2"}) {
    output_of(part + Arguments{"--start-number", "0", "--part", number + std::string("/2")});
  }
  fs::remove(folder_ / "0.png");
  output_of({"join", "--quiet", "%d.png.part-1-of-2", "%d.png.part-2-of-2", "-o", "%d.png"});
  EXPECT_TRUE(is_png("0.png"));
  EXPECT_TRUE(is_png("5.png")) << "what follows stays here too";
  expect_refusal(kSmall + Arguments{"-o", "a.mp4", "--start-number", "3"}, "has no numbers");
  const CommandResult range = piblocks({"render", "--size", "64x36", "--fps", "10", "--to", "0.5",
                                        "--frames", "1-3", "-o", "%d.png"});
  EXPECT_TRUE(range.err.starts_with("%d.png: 3 frames in ")) << range.err;
  EXPECT_TRUE(range.err.ends_with("; 2.png to 4.png\n")) << range.err;
}

/// Under names that an output makes; a name that is given whole is the user's to replace.
TEST_F(OldFilesTest, OfOthersAreReplacedOnlyOnDemand) {
  for (const char* part : {"1/2", "2/2"}) {
    output_of(kSmall + Arguments{"--to", "0.3", "--part", part, "-o", "%d.png"});
  }
  fs::create_directory(folder_ / "talk");
  for (const char* file : {"2.png", "4.png", "talk/alt.txt", "a.mp4.part-1-of-1"}) {
    write(file, "mine");
  }
  const Arguments join{"join", "%d.png.part-1-of-2", "%d.png.part-2-of-2", "-o", "%d.png"};
  const std::vector<std::pair<Arguments, std::string>> commands = {
      {kSmall + Arguments{"--to", "0.3", "-o", "%d.png"}, "2.png"},
      {join, "2.png"},
      {kSmall + Arguments{"--to", "0.3", "--bundle", "talk", "-o", "a.mp4"}, "talk/alt.txt"},
      {kSmall + Arguments{"--part", "1/1", "-o", "a.mp4"}, "a.mp4.part-1-of-1"}};
  for (const auto& [command, file] : commands) {
    const std::string said = refusal(command);
    EXPECT_TRUE(contains(said, file + "' is there"));
    EXPECT_TRUE(contains(said, "--overwrite"));
    EXPECT_EQ(contents(file), "mine");
  }
  for (const auto& [command, file] : commands) {
    EXPECT_EQ(piblocks(command + Arguments{"--overwrite"}).exit_code, 0);
    EXPECT_NE(contents(file), "mine");
    EXPECT_EQ(piblocks(command).exit_code, 0) << "it is piblocks's own now";
  }
  EXPECT_EQ(contents("4.png"), "mine");
  EXPECT_EQ(piblocks(join).err, "%d.png: 3 frames from 2 parts; left 1 other file that follows\n");
}

TEST_F(OldFilesTest, OfALongerSequenceGoWithOneThatIsJoined) {
  render("%d.png", "1");
  for (const char* part : {"1/2", "2/2"}) {
    output_of(kSmall + Arguments{"--to", "0.3", "--part", part, "-o", "%d.png"});
  }
  EXPECT_TRUE(fs::exists(folder_ / "10.png")) << "parts are no sequence yet";
  output_of({"join", "--quiet", "%d.png.part-1-of-2", "%d.png.part-2-of-2", "-o", "%d.png"});
  EXPECT_EQ(entries(),
            (Names{"%d.png.part-1-of-2", "%d.png.part-2-of-2", "1.png", "2.png", "3.png"}));
}

TEST_F(OldFilesTest, OfASequenceStayWhereOneCannotBeReplaced) {
  render("%d.png", "1");
  write("mine.png", "mine");
  fs::remove(folder_ / "2.png");
  fs::create_symlink("mine.png", folder_ / "2.png");
  const std::string first = contents("1.png");
  const Arguments other{"--theme", "dark", "--to", "0.3", "-o", "%d.png"};
  EXPECT_TRUE(contains(refusal(kSmall + other, 1), "'./2.png': a symbolic link"));
  EXPECT_EQ(contents("1.png"), first);
  EXPECT_EQ(contents("mine.png"), "mine");
}

TEST_F(OldFilesTest, OfASequenceBelongToOneRunAtATime) {
  const Arguments endless{"render", "--quiet", "--size", "320x180", "--to", "9999"};
  RunningCommand first(endless + Arguments{"-o", "f/%06d.png"}, {.folder = folder_.path()});
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder_ / "f") && entries().size() > 4; }));
  const CommandResult second = piblocks(kSmall + Arguments{"--to", "0.1", "-o", "f/%06d.png"});
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_TRUE(contains(second.err, "another run is writing it"));
  render("f/other-%06d.png", "0.1");
  EXPECT_TRUE(is_png("f/other-000001.png"));
  first.send(SIGINT);
  EXPECT_EQ(first.wait().exit_code, -SIGINT);
  render("f/%06d.png", "0.1");
  EXPECT_EQ(entries(), (Names{"f", "f/000001.png", "f/other-000001.png"}));
}

}  // namespace
}  // namespace piblocks
