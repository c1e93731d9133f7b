// count, state, info, help and version.
#include <piblocks/two_blocks.hpp>

#include "cli/cli_fixture.hpp"
#include "support/oracle.hpp"

namespace piblocks {
namespace {

using TextCommandsTest = CliFixture;

constexpr const char* kPi = "314159265358979323846264338327950288";

/// A printed position is within its bound of the truth, and the bound is a useful one.
void expect_within_bound(const std::string& state, const char* block, const Rational& truth) {
  const double bound = json_number(state, {block, "position_bound"});
  EXPECT_GT(bound, 0) << state;
  EXPECT_LT(bound, 1e-13) << state;
  EXPECT_LE(abs(Rational(json_number(state, {block, "position"})) - truth), Rational(bound))
      << state;
}

TEST_F(TextCommandsTest, CountPrintsTheDigitsOfPi) {
  for (const std::size_t digits : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 10U, 11U, 12U, 20U, 36U}) {
    EXPECT_EQ(output_of({"count", "--digits", std::to_string(digits)}),
              std::string(kPi).substr(0, digits) + "\n");
  }
}

TEST_F(TextCommandsTest, CountTakesAnyMassRatioExactly) {
  EXPECT_EQ(output_of({"count", "--mass-ratio", "1"}), "3\n");
  EXPECT_EQ(output_of({"count", "--mass-ratio", "1/3"}), "2\n");
  EXPECT_EQ(output_of({"count", "--mass-ratio", "100^7"}), "31415926\n");
  EXPECT_EQ(output_of({"count", "--mass-ratio=1e14"}), "31415926\n");
}

TEST_F(TextCommandsTest, OptionsWinOverTheSceneFile) {
  write("scene.toml", "[red]\nmass = 7\n[blue]\nmass = 2\n");
  EXPECT_EQ(output_of({"count", "scene.toml", "--digits", "4"}), "3141\n");
  EXPECT_EQ(output_of({"count", "--digits", "4", "scene.toml"}), "3141\n");
  EXPECT_NE(output_of({"count", "scene.toml"}), "3141\n");
}

TEST_F(TextCommandsTest, BlocksMayLoseEnergy) {
  const std::string loss = "blocks.restitution = 0.5\nwall.restitution = 0.5\n";
  write("four.toml", "digits = 1\n" + loss);
  EXPECT_EQ(output_of({"count", "four.toml"}), "4\n");
  const auto rows = lines(output_of({"log", "four.toml"}));
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_TRUE(rows.back().ends_with(",0.046875,0.21875")) << rows.back();
  const std::string state = output_of({"state", "four.toml", "--at", "last", "--bounds"});
  EXPECT_EQ(json_number(state, {"blue", "velocity"}), 0.046875);
  EXPECT_LT(json_number(state, {"blue", "position_bound"}), 1e-15);

  write("endless.toml", "digits = 2\n" + loss);
  expect_refusal({"count", "endless.toml"},
                 "infinitely many collisions until the blocks come to rest at t = ");
  expect_refusal({"log", "four.toml", "--engine", "events"}, "its collisions are elastic");
}

TEST_F(TextCommandsTest, StatePrintsOneObjectALine) {
  const auto objects = lines(output_of({"state", "--at", "0,2,7/2,last,#314"}));
  ASSERT_EQ(objects.size(), 5u);
  EXPECT_EQ(objects[0], R"({"time":0,"collisions":"0","blue":{"position":2,"velocity":0},)"
                        R"("red":{"position":5,"velocity":-1}})");
  EXPECT_EQ(json_value(objects[1], {"collisions"}), "1") << "a collision at the instant is counted";
  EXPECT_EQ(json_value(objects[2], {"time"}), "3.5");
  EXPECT_EQ(json_value(objects[3], {"collisions"}), "314");
  EXPECT_EQ(objects[3], objects[4]);
}

TEST_F(TextCommandsTest, StateGoesBackBeforeTimeZeroWithoutNegativeZeros) {
  const std::string state = output_of({"state", "--at", "-3"});
  EXPECT_EQ(json_value(state, {"blue", "velocity"}), "0");
  EXPECT_EQ(json_value(state, {"red", "position"}), "8");
  EXPECT_EQ(json_value(state, {"collisions"}), "0");
}

TEST_F(TextCommandsTest, StateLeavesTheSceneFileAlone) {
  write("scene.toml", "[red]\nmass = 100\n");
  EXPECT_EQ(json_value(output_of({"state", "--at", "last", "scene.toml"}), {"collisions"}), "31");
}

TEST_F(TextCommandsTest, EnginesAgreeOnStates) {
  const Arguments state{"state", "--digits", "2", "--at", "0,2.5,3.3,4,100"};
  const auto unfolded = lines(output_of(state + Arguments{"--engine", "unfolded"}));
  const auto events = lines(output_of(state + Arguments{"--engine", "events"}));
  ASSERT_EQ(unfolded.size(), events.size());
  for (std::size_t i = 0; i < unfolded.size(); ++i) {
    EXPECT_EQ(json_value(unfolded[i], {"collisions"}), json_value(events[i], {"collisions"}));
    for (const char* block : {"blue", "red"}) {
      for (const char* quantity : {"position", "velocity"}) {
        EXPECT_NEAR(json_number(unfolded[i], {block, quantity}),
                    json_number(events[i], {block, quantity}), 1e-9);
      }
    }
  }
}

/// Pictures and 'count' alone: what other programs read is decimal in every base.
TEST_F(TextCommandsTest, CountsAreInTheBaseLogsAreNot) {
  EXPECT_EQ(output_of({"count", "--digits", "5", "--base", "2"}), "110010\n");
  EXPECT_EQ(output_of({"count", "--mass-ratio", "16", "--base", "2"}), "1100\n");
  EXPECT_EQ(output_of({"count", "--digits", "9", "--base", "16"}), "3243f6a88\n");
  EXPECT_EQ(output_of({"count", "--base", "36"}), "8q\n") << "314 without --digits";
  const std::string log = output_of({"log", "--digits", "3", "--base", "2"});
  EXPECT_TRUE(lines(log).back().starts_with("12,")) << log;
  const std::string state = output_of({"state", "--digits", "3", "--base", "2", "--at", "last"});
  EXPECT_EQ(json_value(state, {"collisions"}), "12");
  for (const char* base : {"1", "37", "0", "-2", "5/2", "two", ""}) {
    const std::string said = refusal({"count", "--base", base});
    EXPECT_TRUE(said.starts_with("piblocks: --base")) << said;
    EXPECT_EQ(lines(said).size(), 1U) << said;
  }
}

TEST_F(TextCommandsTest, StateBoundsItsErrors) {
  for (const int digits : {3, 20}) {
    const TwoBlocks system = article_blocks(digits);
    for (const char* text : {"0", "2.5", "3.4999999", "3.5", "4", "100/7"}) {
      const std::string state =
          output_of({"state", "--digits", std::to_string(digits), "--at", text, "--bounds"});
      const oracle::ExactState truth = oracle::high_precision_state(system, parse_rational(text));
      expect_within_bound(state, "blue", truth.blue.position);
      expect_within_bound(state, "red", truth.red.position);
    }
  }
}

TEST_F(TextCommandsTest, StateBoundsCollisions) {
  // The blocks meet where blue has its start: red has come as far as blue's edge.
  const auto states =
      lines(output_of({"state", "--digits", "20", "--at", "#1,#3,last", "--bounds"}));
  ASSERT_EQ(states.size(), 3u);
  expect_within_bound(states[0], "blue", 2);
  expect_within_bound(states[0], "red", 3);
  for (const std::string& state : states) {
    EXPECT_GT(json_number(state, {"blue", "position_bound"}), 0) << state;
    EXPECT_LT(json_number(state, {"blue", "position_bound"}), 1e-13) << state;
  }
}

/// The text without its position bounds.
std::string without_bounds(std::string text) {
  const std::string key = ",\"position_bound\":";
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key)) {
    text.erase(at, text.find(',', at + key.size()) - at);
  }
  return text;
}

TEST_F(TextCommandsTest, StateBoundsAreAddedToTheSameState) {
  const Arguments state{"state", "--at", "0,7/2,#100"};
  EXPECT_EQ(without_bounds(output_of(state + Arguments{"--bounds"})), output_of(state));
}

TEST_F(TextCommandsTest, InfoNamesVersionLibrariesAndLimits) {
  const std::string info = output_of({"info"});
  for (const char* part : {"piblocks ", "Eigen ", "GMP ", "MPFR ", "cairo ", "freetype ",
                           "libavcodec ", "giflib ", "zlib ", "fmt ", "libx264", "libvpx-vp9",
                           "prores_ks", "aac", "libopus", "limits:", "pictures of a sheet: 200"}) {
    EXPECT_TRUE(contains(info, part));
  }
}

TEST_F(TextCommandsTest, EveryCommandHasHelpAndVersion) {
  const std::string version = output_of({"--version"});
  EXPECT_TRUE(version.starts_with("piblocks ")) << version;
  for (const char* command : {"render", "still", "sheet", "log", "state", "count", "info"}) {
    EXPECT_TRUE(contains(output_of({"--help"}), std::string("  ") + command));
    EXPECT_EQ(output_of({command, "--version"}), version);
    const std::string help = output_of({command, "--help"});
    EXPECT_EQ(output_of({command, "-h"}), help);
    EXPECT_TRUE(contains(help, std::string("Usage: piblocks ") + command));
    for (const std::string& line : lines(help)) EXPECT_LE(line.size(), 100u) << line;
  }
}

}  // namespace
}  // namespace piblocks
