// What a person at a terminal sees of a rendering, and what a log file gets.
#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

class TerminalTest : public CliFixture {
 protected:
  void SetUp() override {
    if (!testing_support::has_pseudo_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  }
  /// With a terminal for what is said to people.
  CommandResult at_terminal(const Arguments& arguments, CommandOptions options = {}) const {
    options.folder = folder_.path();
    options.err_is_terminal = true;
    return RunningCommand(arguments, options).wait();
  }
};

const Arguments kRenderForTerminal{"render", "article", "--size", "640x360",
                                   "--to",   "last",    "-o",     "null"};

TEST_F(TerminalTest, ShowsABarThatMakesWayForTheSummary) {
  const CommandResult result = at_terminal(kRenderForTerminal);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(contains(result.err, "\r\x1b[K[                              ]   0 %"));
  const std::size_t last_clear = result.err.rfind("\r\x1b[K");
  ASSERT_NE(last_clear, std::string::npos);
  const std::string summary = result.err.substr(last_clear + 4);
  EXPECT_TRUE(summary.starts_with("null: 742 frames in ")) << summary;
  EXPECT_TRUE(summary.ends_with(" frames/s)\r\n")) << summary;
}

/// Where no scene is named, somebody may not know that there is a film.
TEST_F(TerminalTest, ARenderingWithoutASceneTellsOfTheFilm) {
  const std::string hint = "for a lecture: piblocks render why-pi -o why-pi.mp4\r\n";
  const Arguments bare{"render", "--size", "64x36", "--to", "1", "-o", "null"};
  const std::string said = at_terminal(bare).err;
  EXPECT_TRUE(said.ends_with(" frames/s)\r\n" + hint)) << said;
  EXPECT_EQ(count_of(said, "why-pi -o"), 1U);
  EXPECT_EQ(at_terminal(bare + Arguments{"--quiet"}).err, "");
  EXPECT_FALSE(contains(piblocks(bare).err, "for a lecture")) << "nobody looks at a file";
  EXPECT_FALSE(contains(at_terminal(kRenderForTerminal).err, "for a lecture"));
}

TEST_F(TerminalTest, TheBarTellsRateAndTimeLeft) {
  const Arguments slow{"render", "--size",    "1280x720", "--jobs", "1",       "--to",
                       "last",   "--encoder", "libx264",  "-o",     "slow.mp4"};
  const CommandResult result = at_terminal(slow);
  EXPECT_TRUE(contains(result.err, " frames/s  "));
  EXPECT_TRUE(contains(result.err, " left"));
}

/// A line that wraps cannot be cleared.
TEST_F(TerminalTest, TheBarIsNoWiderThanTheTerminal) {
  const CommandResult result = at_terminal(kRenderForTerminal, {.columns = 20});
  const std::string cleared = "\r\x1b[K";
  std::size_t bars = 0;
  for (std::size_t at = result.err.find(cleared + '['); at != std::string::npos; ++bars) {
    const std::size_t end = result.err.find(cleared, at + 1);
    EXPECT_LE(end - at - cleared.size(), 19U);
    at = result.err.find(cleared + '[', at + 1);
  }
  EXPECT_GE(bars, 1U);
}

TEST_F(TerminalTest, ThatIsDumbGetsNoEscapeSequences) {
  const CommandResult result = at_terminal(kRenderForTerminal, {.environment = {"TERM=dumb"}});
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos) << result.err;
  EXPECT_TRUE(result.err.starts_with("null: 742 frames in ")) << result.err;
}

TEST_F(TerminalTest, ShowsHowFarALogHasComeIfItTakesAWhile) {
  const auto said = [&](const char* rows) {
    return at_terminal({"log", "--digits", "8", "--limit", rows}, {.out_file = "/dev/null"}).err;
  };
  EXPECT_EQ(said("1000"), "");
  const std::string err = said("30e6");
  EXPECT_TRUE(contains(err, " rows/s  "));
  EXPECT_TRUE(err.ends_with("\r\x1b[K")) << err;
}

TEST_F(TerminalTest, AnErrorDoesNotStandBesideTheBar) {
  std::filesystem::create_directory(folder_ / "1.png");
  const Arguments render{"render", "--size", "64x36", "--fps", "10", "--to", "1", "-o", "%d.png"};
  const CommandResult result = at_terminal(render);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err, "\r\x1b[Kpiblocks: output: "));
}

TEST_F(TerminalTest, IsLeftAloneWhenQuiet) {
  EXPECT_EQ(at_terminal(kRenderForTerminal + Arguments{"--quiet"}).err, "");
}

TEST_F(TerminalTest, GetsTextButNoBytes) {
  const auto on_terminal = [&](const Arguments& arguments) {
    return RunningCommand(arguments, {.folder = folder_.path(), .out_is_terminal = true}).wait();
  };
  for (const Arguments& arguments :
       {Arguments{"log", "--format", "npy"}, Arguments{"log", "--format", "npy", "-o", "-"},
        Arguments{"still", "--at", "1", "-o", "-"}, Arguments{"render", "--to", "1", "-o", "-"}}) {
    const CommandResult result = on_terminal(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments.front();
    EXPECT_EQ(result.out, "") << arguments.front();
    EXPECT_EQ(result.err,
              "piblocks: --output -: standard output is a terminal; pipe it or redirect it to a "
              "file\n");
  }
  EXPECT_EQ(lines(on_terminal({"log", "--digits", "1"}).out).size(), 4u);
}

TEST_F(TerminalTest, AFileGetsPlainLines) {
  const CommandResult result = piblocks(kRenderForTerminal);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err.find('\r'), std::string::npos);
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
  EXPECT_TRUE(lines(result.err).back().starts_with("null: 742 frames in ")) << result.err;
}

}  // namespace
}  // namespace piblocks
