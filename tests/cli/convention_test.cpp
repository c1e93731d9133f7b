// The note on scenes whose collisions all happen at once: what is said, by whom, and when not.
#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

constexpr const char* kRestingOnTheWall =
    "[blue]\nposition = 0.5\n[red]\nmass = 100\nposition = 3\nvelocity = -1\n";
constexpr const char* kArrivingTogether =
    "[blue]\nposition = 2\nvelocity = -1\n[red]\nmass = 100\nposition = 3\nvelocity = -1\n";
constexpr const char* kOrdinary = "[red]\nmass = 100\n";

constexpr const char* kBlocksFirst =
    "piblocks: note: all collisions happen at once, at t = 3/2, when blue touches both wall and "
    "red: by convention the blocks meet first, which makes 31 (wall first: 32)\n";
constexpr const char* kWallFirst =
    "piblocks: note: all collisions happen at once, at t = 3/2, when blue touches both wall and "
    "red: by convention blue meets the wall first, which makes 31 (blocks first: 32)\n";

const Arguments kCount{"count", "scene.toml"};
const Arguments kRenderQuietly{"render", "scene.toml", "--size", "64x36", "--fps",
                               "2",      "--to",       "2",      "-o",    "null"};

class ConventionTest : public CliFixture {
 protected:
  CommandResult run(const char* scene, const Arguments& arguments) const {
    write("scene.toml", scene);
    const CommandResult result = piblocks(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result;
  }
};

TEST_F(ConventionTest, SaysWhoIsFirst) {
  for (const auto& [scene, note] :
       {std::pair(kRestingOnTheWall, kBlocksFirst), {kArrivingTogether, kWallFirst}}) {
    const CommandResult count = run(scene, kCount);
    EXPECT_EQ(count.out, "31\n");
    EXPECT_EQ(count.err, note);
  }
}

TEST_F(ConventionTest, NeedsNoNoteInAnOrdinaryScene) {
  EXPECT_EQ(run(kOrdinary, kCount).err, "");
  EXPECT_EQ(run("[blue]\nposition = 0.5\n[red]\nvelocity = 1\n", kCount).err, "") << "none meet";
}

TEST_F(ConventionTest, IsNotedByEveryCommandThatShowsIt) {
  for (const Arguments& arguments :
       {kCount, Arguments{"state", "scene.toml", "--at", "1,last"}, Arguments{"log", "scene.toml"},
        Arguments{"log", "scene.toml", "--engine", "events", "--format", "jsonl"},
        Arguments{"still", "scene.toml", "--at", "last", "--size", "64x36", "-o", "-"}}) {
    EXPECT_EQ(run(kRestingOnTheWall, arguments).err, kBlocksFirst) << arguments.front();
    EXPECT_EQ(run(kOrdinary, arguments).err, "") << arguments.front();
  }
}

TEST_F(ConventionTest, IsNotedBesideARenderingUnlessItIsQuiet) {
  const auto said = lines(run(kRestingOnTheWall, kRenderQuietly).err);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_TRUE(said[0].starts_with("null: 4 frames in ")) << said[0];
  EXPECT_EQ(said[1] + '\n', kBlocksFirst);
  EXPECT_EQ(run(kRestingOnTheWall, kRenderQuietly + Arguments{"--quiet"}).err, "");
}

TEST_F(ConventionTest, TheNoteIsNoPartOfTheOutput) {
  const auto rows = lines(run(kRestingOnTheWall, {"log", "scene.toml"}).out);
  ASSERT_EQ(rows.size(), 32u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto fields = split(rows[i], ',');
    ASSERT_EQ(fields.size(), 7u);
    EXPECT_EQ(fields[1], "1.5");
    EXPECT_EQ(fields[2], i % 2 == 1 ? "blocks" : "wall");
  }
}

TEST_F(ConventionTest, AFailureIsNotExplainedByIt) {
  write("scene.toml", kRestingOnTheWall);
  EXPECT_EQ(lines(refusal({"state", "scene.toml", "--at", "#32"})).size(), 1u);
}

}  // namespace
}  // namespace piblocks
