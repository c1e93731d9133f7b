// render --part and join: pieces made apart, and the same bytes in the end.
#include <fmt/format.h>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using PartTest = CliFixture;

const Arguments kRenderPart{"render", "--size", "64x36", "--fps", "24", "--to", "5", "-o", "a.mp4"};

TEST_F(PartTest, JoinsToTheFileOfASingleRun) {
  output_of(kRenderPart + Arguments{"--quiet"});
  const std::string whole = contents("a.mp4");
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    const CommandResult result = piblocks(kRenderPart + Arguments{"--part", part});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with(fmt::format("a.mp4.part-{}-of-3: ", part[0])));
  }
  EXPECT_EQ(entries(),
            (Names{"a.mp4", "a.mp4.part-1-of-3", "a.mp4.part-2-of-3", "a.mp4.part-3-of-3"}));
  EXPECT_TRUE(contents("a.mp4") == whole);
  const CommandResult joined = piblocks(
      {"join", "a.mp4.part-3-of-3", "a.mp4.part-1-of-3", "a.mp4.part-2-of-3", "-o", "b.mp4"});
  EXPECT_EQ(joined.exit_code, 0);
  EXPECT_EQ(joined.err, "b.mp4: 120 frames from 3 parts\n");
  EXPECT_TRUE(contents("b.mp4") == whole);
}

TEST_F(PartTest, JoinsToStandardOutput) {
  Arguments render = kRenderPart + Arguments{"--quiet"};
  *std::ranges::find(render, "a.mp4") = "a.y4m";
  output_of(render);
  output_of(render + Arguments{"--part", "1/1"});
  EXPECT_TRUE(output_of({"join", "--quiet", "a.y4m.part-1-of-1", "-o", "-"}) == contents("a.y4m"));
}

TEST_F(PartTest, AShareMayBeEmpty) {
  const Arguments few{"render", "--size", "64x36", "--to", "0.1", "-o", "a.y4m", "--profile"};
  for (const char* part : {"1/4", "2/4", "3/4", "4/4"}) {
    const CommandResult result = piblocks(few + Arguments{"--part", part});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_FALSE(contains(result.err, "nan"));
    EXPECT_FALSE(contains(result.err, "inf"));
  }
  output_of({"join", "--quiet", "a.y4m.part-1-of-4", "a.y4m.part-2-of-4", "a.y4m.part-3-of-4",
             "a.y4m.part-4-of-4", "-o", "b.y4m"});
  output_of({"render", "--quiet", "--size", "64x36", "--to", "0.1", "-o", "c.y4m"});
  EXPECT_TRUE(contents("b.y4m") == contents("c.y4m"));
}

TEST_F(PartTest, ADamagedPartFailsAndLeavesTheOldFile) {
  output_of(kRenderPart + Arguments{"--quiet", "--part", "1/1"});
  const std::string part = contents("a.mp4.part-1-of-1");
  write("a.mp4.part-1-of-1", part.substr(0, part.size() / 2));
  write("b.mp4", "old");
  EXPECT_EQ(refusal({"join", "a.mp4.part-1-of-1", "-o", "b.mp4"}, 1),
            "piblocks: part: 'a.mp4.part-1-of-1' is damaged or cut off; render it again\n");
  EXPECT_EQ(contents("b.mp4"), "old");
}

TEST_F(PartTest, ResumingKeepsAPartThatIsWhole) {
  const Arguments resume = kRenderPart + Arguments{"--part", "2/3", "--resume"};
  const std::string name = "a.mp4.part-2-of-3";
  EXPECT_FALSE(contains(piblocks(resume).err, "kept"));
  const std::string part = contents(name);
  EXPECT_TRUE(piblocks(resume).err.ends_with("; kept what an earlier run has made\n"));
  EXPECT_TRUE(contents(name) == part);
  for (const std::size_t size : {part.size() / 2, part.size() - 1}) {
    write(name, part.substr(0, size));
    EXPECT_FALSE(contains(piblocks(resume).err, "kept")) << "damaged";
    EXPECT_TRUE(contents(name) == part);
  }
  std::string changed = part;
  changed[part.size() / 2] ^= 1;
  write(name, changed);
  EXPECT_FALSE(contains(piblocks(resume).err, "kept")) << "damaged";
  EXPECT_TRUE(contents(name) == part);
}

TEST_F(PartTest, ResumingRefusesAPartOfAnotherJob) {
  const Arguments resume = kRenderPart + Arguments{"--part", "2/3", "--resume"};
  const std::string name = "a.mp4.part-2-of-3";
  output_of(kRenderPart + Arguments{"--quiet", "--part", "2/3", "--digits", "2"});
  const std::string other = contents(name);
  EXPECT_TRUE(contains(refusal(resume, 2), fmt::format("'{}' is of another job: it differs in "
                                                       "red.mass; give the same command",
                                                       name)));
  EXPECT_TRUE(contents(name) == other);
  output_of(kRenderPart + Arguments{"--quiet", "--part", "1/3"});
  write(name, contents("a.mp4.part-1-of-3"));
  EXPECT_TRUE(contains(refusal(resume, 2), "it differs in part;"));
  write(name, "a letter");
  EXPECT_TRUE(contains(refusal(resume, 2), "is there, but not a part file"));
  EXPECT_EQ(contents(name), "a letter");
}

/// The line of the table that starts with this name, cut into words.
std::vector<std::string> row(const std::string& table, const std::string& name) {
  for (const std::string& line : lines(table)) {
    std::istringstream words(line);
    std::vector<std::string> row{std::istream_iterator<std::string>(words), {}};
    if (!row.empty() && row.front() == name) return row;
  }
  return {};
}

TEST_F(PartTest, AProfileNamesTheEncoderOfEachChunk) {
  const auto profile = [this](const Arguments& arguments) {
    return piblocks(kRenderPart + arguments + Arguments{"--profile", "--quiet"}).err;
  };
  EXPECT_TRUE(contains(profile({}), "by builtin\n"));
  EXPECT_FALSE(contains(profile({"--encoder", "libx264"}), "chunks"));
}

TEST_F(PartTest, AProfileAddsUp) {
  const CommandResult result = piblocks(kRenderPart + Arguments{"--profile", "--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  double spent_s = 0;
  double share = 0;
  for (const char* stage : {"compose", "paint", "convert", "encode", "mux", "write", "other"}) {
    const auto words = row(result.err, stage);
    ASSERT_EQ(words.size(), 7u) << result.err;
    EXPECT_GE(std::stod(words[1]), 0);
    spent_s += std::stod(words[1]);
    share += std::stod(words[5]);
  }
  const auto total = row(result.err, "total");
  ASSERT_EQ(total.size(), 7u) << result.err;
  EXPECT_NEAR(std::stod(total[1]), spent_s, 0.0041);
  EXPECT_NEAR(share, 100, 0.41);
  EXPECT_GT(std::stod(row(result.err, "encode")[1]), 0);
}

}  // namespace
}  // namespace piblocks
