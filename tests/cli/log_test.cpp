// log: rows, their selection and their form.
#include <cmath>
#include <utility>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using LogTest = CliFixture;

constexpr const char* kHeader = "index,time,kind,x_blue,x_red,v_blue,v_red";

TEST_F(LogTest, PrintsTheCollisionsOfEqualMasses) {
  EXPECT_EQ(output_of({"log", "--digits", "1"}), std::string(kHeader) +
                                                     "\n1,2,blocks,2,3,-1,0"
                                                     "\n2,3.5,wall,0.5,3,1,0"
                                                     "\n3,5,blocks,2,3,0,1\n");
}

TEST_F(LogTest, HasARowForEveryCollision) {
  const auto rows = lines(output_of({"log", "--digits", "4"}));
  ASSERT_EQ(rows.size(), 1u + 3141u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto fields = split(rows[i], ',');
    ASSERT_EQ(fields.size(), 7u) << rows[i];
    EXPECT_EQ(fields[0], std::to_string(i));
    EXPECT_EQ(fields[2], i % 2 == 1 ? "blocks" : "wall");
  }
}

class EnginesLogTest : public CliFixture, public testing::WithParamInterface<int> {};

/// Velocities and positions compare with the largest that the run has: near the turning point
/// the event loop has lost the small ones.
TEST_P(EnginesLogTest, EnginesAgree) {
  const Arguments log{"log", "--digits", std::to_string(GetParam()), "--engine"};
  const auto unfolded = lines(output_of(log + Arguments{"unfolded"}));
  const auto events = lines(output_of(log + Arguments{"events"}));
  ASSERT_EQ(unfolded.size(), events.size());
  const double largest_velocity = std::pow(10.0, GetParam() - 1);
  const std::vector<double> scales{10, 0, 10, 10, largest_velocity, 1};  // from "time" on
  for (std::size_t row = 1; row < unfolded.size(); ++row) {
    const auto a = split(unfolded[row], ',');
    const auto b = split(events[row], ',');
    ASSERT_EQ(a[0], b[0]);
    ASSERT_EQ(a[2], b[2]) << "row " << row;
    for (const std::size_t column : {1U, 3U, 4U, 5U, 6U}) {
      ASSERT_NEAR(std::stod(a[column]), std::stod(b[column]), 1e-9 * scales[column - 1])
          << "row " << row << ", column " << column;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Digits, EnginesLogTest, testing::Values(1, 4));

TEST_F(LogTest, BoundsOfTimeIncludeWhatHappensAtThem) {
  using Rows = std::vector<std::string>;
  const auto rows = [&](const Arguments& selection) {
    return indices(output_of(Arguments{"log", "--digits", "1"} + selection));
  };
  EXPECT_EQ(rows({"--from", "2", "--to", "5"}), (Rows{"1", "2", "3"}));
  EXPECT_EQ(rows({"--from", "2.0000001", "--to", "4.9999999"}), (Rows{"2"}));
  EXPECT_EQ(rows({"--from", "7/2", "--to", "7/2"}), (Rows{"2"}));
  EXPECT_EQ(rows({"--from", "3.6", "--to", "3.7"}), (Rows{}));
  EXPECT_EQ(rows({"--from", "-9"}), (Rows{"1", "2", "3"}));
  EXPECT_EQ(rows({"--to", "-9"}), (Rows{}));
  EXPECT_EQ(rows({"--from", "1e300"}), (Rows{}));
}

TEST_F(LogTest, BoundsMayBeAnyInstant) {
  EXPECT_EQ(indices(output_of({"log", "--from", "#312"})), (Names{"312", "313", "314"}));
  EXPECT_EQ(indices(output_of({"log", "--from", "last-1"})), Names{"314"});
  EXPECT_EQ(indices(output_of({"log", "--from", "turn", "--to", "#160-1/1000000"})),
            (Names{"158", "159"}));
}

// However many happen at once: none of them is asked for its time.
TEST_F(LogTest, BoundsOfTimeIncludeAllThatHappensAtOnce) {
  write("corner.toml", "blue.position = 0.5\n");
  const auto rows = [&](const Arguments& selection) {
    return indices(piblocks(Arguments{"log", "corner.toml"} + selection).out);
  };
  for (const char* digits : {"2", "5", "20", "150"}) {
    for (const char* from : {"3.5", "turn"}) {
      EXPECT_EQ(rows({"--digits", digits, "--from", from, "--limit", "2"}), (Names{"1", "2"}))
          << digits << " digits from " << from;
    }
  }
  EXPECT_TRUE(rows({"--from", "3.5000001"}).empty());
  EXPECT_EQ(rows({"--digits", "2", "--from", "3.5", "--engine", "events"}).size(), 31U);
}

TEST_F(LogTest, GoesOnBeforeTimeZero) {
  write("recede.toml", "red.velocity = 1\nred.position = 3\n");
  EXPECT_TRUE(indices(output_of({"log", "recede.toml"})).empty());
  const auto before = indices(output_of({"log", "recede.toml", "--from=-20"}));
  ASSERT_EQ(before.size(), 314U);
  EXPECT_EQ(before.front(), "-313");
  EXPECT_EQ(before[304], "-9");
  EXPECT_EQ(before.back(), "0");
  EXPECT_EQ(indices(output_of({"log", "recede.toml", "--first", "-11", "--limit", "3"})),
            (Names{"-11", "-10", "-9"}));
  EXPECT_TRUE(
      contains(output_of({"state", "recede.toml", "--at", "#-7"}), "\"collisions\":\"-7\""));
}

TEST_F(LogTest, SelectsByIndexAndLimit) {
  using Rows = std::vector<std::string>;
  const auto rows = [&](const Arguments& selection) {
    return indices(output_of(Arguments{"log"} + selection));
  };
  EXPECT_EQ(rows({"--limit", "2"}), (Rows{"1", "2"}));
  EXPECT_EQ(rows({"--first", "313"}), (Rows{"313", "314"}));
  EXPECT_EQ(rows({"--first", "313", "--limit", "1"}), (Rows{"313"}));
  EXPECT_EQ(rows({"--first", "314", "--limit", "99"}), (Rows{"314"}));
  EXPECT_EQ(rows({"--first", "1", "--from", "5", "--limit", "1"}), (Rows{"314"}));
  EXPECT_EQ(rows({"--first", "314", "--to", "3"}), (Rows{}));
}

TEST_F(LogTest, ReachesTheMiddleOfTwentyDigits) {
  const auto rows = lines(
      output_of({"log", "--digits", "20", "--first", "15707963267948966190", "--limit", "5"}));
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto fields = split(rows[i], ',');
    EXPECT_EQ(fields[0], std::to_string(15707963267948966189ULL + i));
    EXPECT_EQ(fields[1], "3.5");
    EXPECT_EQ(fields[2], i % 2 == 1 ? "wall" : "blocks");
    EXPECT_EQ(std::fabs(std::stod(fields[5])), 1e19);
  }
}

/// Runs of any length are the rows of the whole: batches leave no trace.
TEST_F(LogTest, ARunOfRowsIsAPartOfTheWhole) {
  const auto all = lines(output_of({"log", "--digits", "4"}));
  const std::vector<std::pair<int, int>> runs{
      {1, 1}, {512, 3}, {513, 1}, {1024, 1025}, {1570, 600}};
  for (const auto& [first, count] : runs) {
    const auto run = lines(output_of({"log", "--digits", "4", "--first", std::to_string(first),
                                      "--limit", std::to_string(count)}));
    ASSERT_EQ(run.size(), 1U + static_cast<unsigned>(count));
    for (std::size_t i = 1; i < run.size(); ++i) {
      const auto a = split(run[i], ',');
      const auto b = split(all[static_cast<unsigned>(first) + i - 1], ',');
      ASSERT_EQ(a[0], b[0]);
      ASSERT_EQ(a[2], b[2]);
      ASSERT_NEAR(std::stod(a[1]), std::stod(b[1]), 1e-14);
    }
  }
}

TEST_F(LogTest, WritesAFileInTheFormatOfItsEnding) {
  write("scene.toml", "digits = 2\n");
  for (const auto& [file, format] : {std::pair{"a/log.csv", "csv"},
                                     {"log", "csv"},
                                     {"log.JSONL", "jsonl"},
                                     {"log.npy", "npy"}}) {
    const std::string rows = output_of({"log", "scene.toml", "--format", format});
    EXPECT_EQ(output_of({"log", "scene.toml", "-o", file}), "");
    EXPECT_EQ(contents(file), rows) << file;
    output_of({"log", "scene.toml", "--format", format, "-o", "log.dat"});
    EXPECT_EQ(contents("log.dat"), rows) << "another ending says nothing";
  }
  std::filesystem::remove(folder_ / "log.dat");
  expect_refusal({"log", "scene.toml", "-o", "log.dat"},
                 "log: 'log.dat' has no known ending; use .csv, .jsonl or .npy, or say the format "
                 "by --format");
  expect_refusal({"log", "scene.toml", "--format", "csv", "-o", "new.npy"},
                 "--format csv: 'new.npy' is a name of npy; leave out --format");
}

/// A row of the closed form is computed when it is written: none is kept.
TEST_F(LogTest, MemoryDoesNotGrowWithTheRows) {
  if (!testing_support::kTellsMemory) GTEST_SKIP() << "a sanitizer keeps freed memory";
  const auto memory_KiB = [&](const char* limit) {
    const CommandResult result = piblocks({"log", "--digits", "9", "--limit", limit, "-o", "x"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.max_memory_KiB;
  };
  const long few = memory_KiB("10");
  EXPECT_LT(memory_KiB("300000"), few + 4096);
  EXPECT_LT(few, 100 * 1024);
}

}  // namespace
}  // namespace piblocks
