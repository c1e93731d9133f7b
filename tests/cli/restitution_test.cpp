// Blocks that lose energy, from outside: the option, and what says that collisions are infinitely
// many.
#include <fmt/format.h>
#include <piblocks/two_blocks.hpp>

#include "cli/cli_fixture.hpp"
#include "support/inelastic_run.hpp"

namespace piblocks {
namespace {

class RestitutionTest : public CliFixture {
 protected:
  /// Standard output of a command that has something to say, which is not looked at.
  std::string rows_of(const Arguments& arguments) const {
    const CommandResult result = piblocks(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }
};

TwoBlocks lossy(int digits, const Rational& blocks, const Rational& wall) {
  TwoBlocks system = article_blocks(digits);
  system.blocks_restitution = blocks;
  system.wall_restitution = wall;
  return system;
}

const Arguments kEndless{"--digits", "2", "--restitution", "0.5"};

TEST_F(RestitutionTest, TheOptionSetsThatOfBlocksAndWall) {
  for (const char* share : {"0.99", "0.999", "1", "19999/20000"}) {
    const Rational exact = parse_rational(share);
    const auto run = oracle::inelastic_run(lossy(3, exact, exact), 500);
    ASSERT_TRUE(run.ended) << share;
    EXPECT_EQ(output_of({"count", "--digits", "3", "--restitution", share}),
              fmt::format("{}\n", run.events.size()));
  }
  write("scene.toml", "digits = 1\nblocks.restitution = 0\nwall.restitution = 0.3\n");
  const auto half = output_of({"log", "--digits", "1", "--restitution", "1/2"});
  EXPECT_EQ(output_of({"log", "scene.toml", "--restitution", "1/2"}), half);
  EXPECT_TRUE(half.ends_with(",0.046875,0.21875\n")) << half;
}

TEST_F(RestitutionTest, EveryCommandWithSceneOptionsHasIt) {
  for (const char* command : {"render", "still", "sheet", "state", "log", "count"}) {
    EXPECT_TRUE(contains(output_of({command, "--help"}), "--restitution E")) << command;
  }
  output_of({"still", "--restitution", "0.99", "--at", "last", "--size", "64x36", "-o", "a.png"});
}

TEST_F(RestitutionTest, WrongValuesAreNamed) {
  for (const char* share : {"1.01", "-1/9", "much"}) {
    expect_refusal({"count", "--restitution", share}, "piblocks: --restitution: restitution = ");
  }
  expect_refusal({"still", "--restitution", "0.9", "--show", "digits", "--at", "0", "-o", "a.png"},
                 "show.overlays has 'digits', which needs elastic collisions");
}

TEST_F(RestitutionTest, StatesSayThatCollisionsAreInfinitelyMany) {
  const auto states = lines(output_of(
      Arguments{"state", "--at", "0,#1,#7,last,9", "--digits", "2", "--restitution", "0.5"}));
  ASSERT_EQ(states.size(), 5u);
  std::vector<std::string> counts;
  for (const std::string& state : states) counts.push_back(json_value(state, {"collisions"}));
  EXPECT_EQ(counts, (Names{"0", "1", "7", "infinite", "infinite"}));
  EXPECT_EQ(json_value(states.back(), {"red", "velocity"}), "0");
  // A run that ends has a number.
  const auto ended = output_of({"state", "--digits", "1", "--restitution", "0.5", "--at", "last"});
  EXPECT_EQ(json_value(ended, {"collisions"}), "4");
}

TEST_F(RestitutionTest, ALogSaysThatItIsNotAll) {
  const Integer listed = collapse_of(lossy(2, Rational(1, 2), Rational(1, 2)))->listed;
  const CommandResult log = piblocks(Arguments{"log"} + kEndless);
  EXPECT_EQ(log.exit_code, 0);
  EXPECT_EQ(Integer(lines(log.out).size() - 1), listed);
  EXPECT_EQ(log.err.find("piblocks: note: there are infinitely many collisions until the blocks "
                         "come to rest at t = 3.530"),
            0u)
      << log.err;
  EXPECT_TRUE(contains(log.err, "lists the first " + listed.get_str()));
  output_of({"log", "--digits", "1", "--restitution", "0.5"});  // says nothing
  const std::string beyond = Integer(listed + 1).get_str();
  const std::string lists = "infinitely many collisions, of which the log lists ";
  expect_refusal(Arguments{"log", "--first", beyond} + kEndless, lists + "1 to ");
  expect_refusal(Arguments{"state", "--at", "#" + beyond} + kEndless, lists + "#1 to #");
}

TEST_F(RestitutionTest, APageSaysInfinitelyMany) {
  output_of(Arguments{"render", "--quiet", "--size", "64x36", "--fps", "10", "--to", "5", "-o",
                      "a.html"} +
            kEndless);
  const std::string page = contents("a.html");
  const Integer listed = collapse_of(lossy(2, Rational(1, 2), Rational(1, 2)))->listed;
  EXPECT_FALSE(contains(page, listed.get_str() + " collisions"));
  EXPECT_TRUE(contains(page, "a counter reaches infinitely many collisions"));
}

TEST_F(RestitutionTest, CountsUntilAnInstant) {
  const auto run = oracle::inelastic_run(lossy(2, Rational(1, 2), Rational(1, 2)), 40);
  for (const char* to : {"1.9", "2", "3", "3.2", "3.5"}) {
    EXPECT_EQ(output_of(Arguments{"count", "--to", to} + kEndless),
              fmt::format("{}\n", run.count_at(parse_rational(to))));
  }
  EXPECT_EQ(output_of(Arguments{"count", "--to", "#7"} + kEndless), "7\n");
  expect_refusal(Arguments{"count", "--to", "4"} + kEndless, "infinitely many collisions until");
  EXPECT_EQ(output_of({"count", "--to", "3.5"}), "157\n");
  EXPECT_EQ(output_of({"count", "--to", "100"}), "314\n");
  EXPECT_EQ(output_of({"count", "--to", "last", "--base", "2", "--mass-ratio", "16"}), "1100\n");
  EXPECT_EQ(output_of({"count", "--digits", "30", "--to", "turn"}).size(), 31u);
}

/// Bodies whose collisions end by themselves, too.
TEST_F(RestitutionTest, CountsBodiesUntilAnInstant) {
  write("three.toml",
        "[[body]]\nposition = 0\nvelocity = 1\n[[body]]\nposition = 2\n[[body]]\nposition = 4\n");
  EXPECT_EQ(output_of({"count", "three.toml"}), "2\n");
  EXPECT_EQ(output_of({"count", "three.toml", "--to", "0.9"}), "0\n");
  EXPECT_EQ(output_of({"count", "three.toml", "--to", "1"}), "1\n");
  EXPECT_EQ(output_of({"count", "three.toml", "--to", "#2-0.5"}), "1\n");
  EXPECT_EQ(output_of({"count", "three.toml", "--to", "50"}), "2\n");
}

/// Worked by hand: the blocks stick together at t = 2 and meet the wall at t = 5, where all other
/// collisions happen.
TEST_F(RestitutionTest, ALogFromTheCornerHasAllThatHappensInIt) {
  write("elastic-wall.toml", "digits = 1\nblocks.restitution = 0\n");
  write("lossy-wall.toml", "digits = 1\nblocks.restitution = 0\nwall.restitution = 0.5\n");
  for (const char* scene : {"elastic-wall.toml", "lossy-wall.toml"}) {
    const auto all = indices(rows_of({"log", scene}));
    ASSERT_GE(all.size(), 3u);
    const auto corner = indices(rows_of({"log", scene, "--from", "5"}));
    EXPECT_EQ(corner, (std::vector(all.begin() + 1, all.end()))) << scene;
    EXPECT_EQ(indices(rows_of({"log", scene, "--from", "2"})), all);
    EXPECT_EQ(indices(rows_of({"log", scene, "--from", "2.5"})), corner);
    EXPECT_EQ(indices(rows_of({"log", scene, "--from", "5.001"})).size(), 0u);
  }
  // The wall takes all of blue's speed at t = 7/2; collision 3 is the first in the corner.
  write("dead-wall.toml",
        "digits = 1\nwall.restitution = 0\nblue.velocity = -1\nred.velocity = -1\n");
  const auto run = oracle::inelastic_run(
      [] {
        TwoBlocks system = lossy(1, 1, 0);
        system.blue.velocity = system.red.velocity = -1;
        return system;
      }(),
      50);
  for (const auto& event : run.events) {
    const auto since = std::size_t(std::ranges::count_if(
        run.events, [&](const auto& other) { return other.time >= event.time; }));
    EXPECT_EQ(indices(rows_of({"log", "dead-wall.toml", "--from", event.time.get_str()})).size(),
              since);
  }
}

}  // namespace
}  // namespace piblocks
