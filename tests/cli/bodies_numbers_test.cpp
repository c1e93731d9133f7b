// Counts, logs and states of bodies, as the program prints them.
#include <fmt/format.h>

#include <cmath>

#include "cli/bodies_fixture.hpp"

namespace piblocks {
namespace {

TEST_F(BodiesCli, SayWhenTheOrderOfPairsDecides) {
  write("tie.toml",
        "[[body]]\nposition = 0\nvelocity = 1\n[[body]]\nposition = 3\n[[body]]\nposition = 6\n"
        "velocity = -1\n");
  const std::string note =
      "piblocks: note: at t = 2 a body has several collisions at once: those of movable bodies "
      "come first, in the order of the file; another order may end otherwise\n";
  for (const Arguments& command :
       {Arguments{"count", "tie.toml"}, Arguments{"log", "tie.toml"},
        Arguments{"state", "tie.toml", "--at", "3"},
        Arguments{"still", "tie.toml", "--at", "3", "-o", "tie.png"},
        Arguments{"sheet", "tie.toml", "--at", "1,3", "-o", "tie.pdf"}}) {
    const CommandResult result = piblocks(command);
    EXPECT_EQ(result.exit_code, 0) << command[0];
    // Sheets say more.
    EXPECT_TRUE(result.err.starts_with(note)) << command[0];
  }
  EXPECT_TRUE(piblocks({"state", "tie.toml", "--at", "1"}).err.empty()) << "not yet";
  EXPECT_TRUE(piblocks({"log", "tie.toml", "--to", "1"}).err.empty()) << "not yet";
  EXPECT_TRUE(piblocks({"still", "tie.toml", "--at", "1", "-o", "tie.png"}).err.empty());
  const CommandResult film =
      piblocks({"render", "tie.toml", "--size", "160x90", "--fps", "4", "-o", "tie.gif"});
  EXPECT_EQ(film.exit_code, 0);
  EXPECT_TRUE(contains(film.err, note));
}

TEST_F(BodiesCli, ATieAtTheLastInstantIsSaid) {
  // The nearest double is later than 1/10.
  write("tie.toml",
        "[[body]]\nposition = 0\nvelocity = 1\n[[body]]\nposition = 1.1\n"
        "[[body]]\nposition = 2.2\nvelocity = -1\n");
  const std::string said = "piblocks: note: at t = 0.1 a body has several collisions at once";
  for (const Arguments& command :
       {Arguments{"count", "tie.toml", "--to", "0.1"}, Arguments{"log", "tie.toml", "--to", "0.1"},
        Arguments{"state", "tie.toml", "--at", "0.1"}}) {
    EXPECT_TRUE(piblocks(command).err.starts_with(said)) << command[0];
  }
}

TEST_F(BodiesCli, CountsAreThoseOfTheLog) {
  for (const char* scene : kBodyScenes) {
    const auto rows = lines(output_of({"log", scene}));
    EXPECT_EQ(first_line_of({"count", scene}), std::to_string(rows.size() - 1)) << scene;
    ASSERT_GT(rows.size(), 1U) << scene;
    double before = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const auto fields = split(rows[i], ',');
      ASSERT_EQ(fields[0], std::to_string(i)) << scene;
      ASSERT_GE(std::stod(fields[1]), before) << scene;
      before = std::stod(fields[1]);
    }
  }
}

TEST_F(BodiesCli, TheEventLoopStepsThemToo) {
  for (const char* scene : kBodyScenes) {
    SCOPED_TRACE(scene);
    const auto rows = lines(output_of({"log", scene, "--limit", "4"}));
    const auto stepped = lines(output_of({"log", scene, "--limit", "4", "--engine", "events"}));
    ASSERT_EQ(rows.size(), stepped.size());
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const auto fields = split(rows[i], ',');
      const auto doubles = split(stepped[i], ',');
      ASSERT_EQ(fields.size(), doubles.size());
      for (std::size_t at = 0; at < fields.size(); ++at) {
        if (at == 2 || at == 3) {  // the bodies
          EXPECT_EQ(fields[at], doubles[at]);
        } else {
          EXPECT_NEAR(std::stod(fields[at]), std::stod(doubles[at]), 1e-9);
        }
      }
    }
  }
}

TEST_F(BodiesCli, CountsOfEndlessRunsNeedATime) {
  expect_line({"count", "endless.toml"},
              "time.to: these bodies may collide for ever; say until when, as time.to = 10");
  for (const char* to : {"1", "5", "50", "1/3"}) {
    const auto rows = lines(output_of({"log", "endless.toml", "--to", to}));
    EXPECT_EQ(first_line_of({"count", "endless.toml", "--to", to}),
              std::to_string(rows.size() - 1));
  }
  for (const char* to : {"--to=-3", "--to=0"}) {
    EXPECT_EQ(output_of({"count", "endless.toml", to}), "0\n");
  }
  write("late.toml", kClosedBox + std::string("[time]\nfrom = 20\nto = 30\n"));
  EXPECT_EQ(output_of({"count", "late.toml", "--to", "5"}),
            output_of({"count", "endless.toml", "--to", "5"}));
}

TEST_F(BodiesCli, IndicesThatDoNotFitAreRefused) {
  write("long.toml",
        "[[body]]\nmass = 'inf'\nposition = -1\n[[body]]\nposition = 2\n"
        "[[body]]\nmass = '1e58'\nposition = 5\nvelocity = -1\n");
  const Arguments rows{"log", "long.toml", "--first", "1" + std::string(28, '0'), "--limit", "2"};
  const auto printed = lines(output_of(rows));
  ASSERT_EQ(printed.size(), 3U);
  EXPECT_TRUE(printed[2].starts_with("1" + std::string(27, '0') + "1,"));
  expect_line(rows + Arguments{"--format", "npy", "-o", "a.npy"},
              "log: index 10,000,000,000,000,000,000,000,000,000 does not fit in 64 bits of npy; "
              "use csv or jsonl");
}

/// Equal blocks exchange velocities: each line is met by one that runs through them.
TEST_F(BodiesCli, CountsOfEqualBlocksAreKnown) {
  write("equal.toml",
        "[box]\nx = [0, 10]\n[[body]]\nposition = 0.5\nvelocity = 1\n[[body]]\nposition = 4.5\n"
        "[[body]]\nposition = 7.5\n[[body]]\nposition = 9.5\n");
  // Without their widths they are points at 0, 3, 5 and 6 of 6; in 12 the moving one runs there and
  // back, and at 6 meets the last, the wall, and the last again.
  for (const std::string to : {"2.99", "3", "5", "6", "6.99", "7", "9", "12", "119.5", "1200"}) {
    const CommandResult result = piblocks({"count", "equal.toml", "--to", to});
    EXPECT_TRUE(result.err.empty()) << "the last one touches the wall: only one order is possible";
    const std::string found = lines(result.out).at(0);
    const double rounds = std::floor(std::stod(to) / 12);
    const double rest = std::stod(to) - 12 * rounds;
    int expected = static_cast<int>(8 * rounds);
    for (const double hit : {3.0, 5.0, 6.0, 6.0, 6.0, 7.0, 9.0}) expected += hit <= rest ? 1 : 0;
    EXPECT_EQ(found, std::to_string(expected)) << to;
  }
}

TEST_F(BodiesCli, StatesAreExactAndInOrder) {
  EXPECT_EQ(output_of({"state", "meeting.toml", "--at", "0,3,5,last"}),
            R"({"time":0,"collisions":"0","bodies":[{"position":0,"velocity":1},)"
            R"({"position":4,"velocity":0},{"position":-20,"velocity":0}]})"
            "\n"
            R"({"time":3,"collisions":"1","bodies":[{"position":3,"velocity":-0.5},)"
            R"({"position":4,"velocity":0.5},{"position":-20,"velocity":0}]})"
            "\n"
            R"({"time":5,"collisions":"1","bodies":[{"position":2,"velocity":-0.5},)"
            R"({"position":5,"velocity":0.5},{"position":-20,"velocity":0}]})"
            "\n"
            R"({"time":47,"collisions":"2","bodies":[{"position":-19,"velocity":0},)"
            R"({"position":26,"velocity":0.5},{"position":-20,"velocity":-0.5}]})"
            "\n");
  expect_line({"state", "meeting.toml", "--at=-1"},
              "time -1: the motion of bodies begins at time 0; give a later time");
  expect_line(
      {"state", "meeting.toml", "--at", "turn"},
      "'turn': there is no turn; only two blocks beside a wall have one, if they move; give "
      "a time");
  expect_line({"state", "meeting.toml", "--at", "#3"},
              "collision #3: the scene has collisions #1 to #2");
}

TEST_F(BodiesCli, RowsAreSelected) {
  using Rows = std::vector<std::string>;
  const auto rows = [&](const Arguments& selection) {
    return indices(output_of(Arguments{"log"} + selection));
  };
  EXPECT_EQ(rows({"meeting.toml", "--from", "3"}), (Rows{"1", "2"}));
  EXPECT_EQ(rows({"meeting.toml", "--from", "3.0000001"}), (Rows{"2"}));
  EXPECT_EQ(rows({"meeting.toml", "--to", "47"}), (Rows{"1", "2"}));
  EXPECT_EQ(rows({"meeting.toml", "--to", "#1"}), (Rows{"1"}));
  EXPECT_EQ(rows({"meeting.toml", "--to", "2"}), Rows());
  EXPECT_EQ(rows({"meeting.toml", "--first", "2"}), (Rows{"2"}));
  EXPECT_EQ(rows({"three-blocks", "--first", "3", "--limit", "2"}), (Rows{"3", "4"}));
  EXPECT_EQ(rows({"three-blocks", "--limit", "1"}), (Rows{"1"}));
  EXPECT_EQ(rows({"three-blocks", "--from", "last"}), (Rows{"47"}));
  EXPECT_EQ(rows({"billiard", "--from", "#7", "--to", "#9"}), (Rows{"7", "8", "9"}));
  EXPECT_EQ(rows({"three-blocks", "--to", "2.1973684210526"}), (Rows{"1"}));
}

TEST_F(BodiesCli, ComputesFurtherThanTheFilmIfAskedTo) {
  const auto rows = lines(output_of({"log", "two-walls", "--to", "60"}));
  EXPECT_GT(std::stod(split(rows.back(), ',')[1]), 59);
  EXPECT_TRUE(contains(output_of({"state", "two-walls", "--at", "60"}),
                       fmt::format("\"collisions\":\"{}\"", rows.size() - 1)));
}

}  // namespace
}  // namespace piblocks
