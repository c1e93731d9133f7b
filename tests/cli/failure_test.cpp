// Outputs that fail while they are written: exit code 1, a message, nothing left behind.
#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using FailureTest = CliFixture;

Arguments words(const std::string& line) { return split(line, ' '); }

class FullDiskTest : public CliFixture, public testing::WithParamInterface<const char*> {};

TEST_P(FullDiskTest, IsReported) {
  const CommandResult result = testing_support::run_command(
      words(GetParam()), {.folder = folder_.path(), .out_file = "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(result.err.starts_with("piblocks: ")) << result.err;
  EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
  EXPECT_EQ(lines(result.err).size(), 1u) << result.err;
}
INSTANTIATE_TEST_SUITE_P(StandardOutput, FullDiskTest,
                         testing::Values("--help", "--version", "info", "render --help",
                                         "count --digits 3", "state --at 1", "log --limit 2",
                                         "log --digits 6", "still --at 1 --size 64x36 -o -",
                                         "render --quiet --size 64x36 --to 1 -o -"));

class ClosedPipeTest : public CliFixture, public testing::WithParamInterface<const char*> {};

TEST_P(ClosedPipeTest, IsReported) {
  RunningCommand command(words(GetParam()), {.folder = folder_.path()});
  command.close_output_after_one_byte();
  const CommandResult result = command.wait();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "piblocks: output: cannot write 'standard output': Broken pipe\n");
}
INSTANTIATE_TEST_SUITE_P(StandardOutput, ClosedPipeTest,
                         testing::Values("log --digits 8",
                                         "render --quiet --size 320x180 --jobs 3 -o -"));

TEST_F(FailureTest, ThatTheEngineCannotRepresentIsNoNumber) {
  const CommandResult result = piblocks({"state", "--mass-ratio", "1e-700", "--at", "last"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "") << "JSON has no infinity";
  EXPECT_NE(result.err.find("range of a double"), std::string::npos) << result.err;
}

TEST_F(FailureTest, AFrameThatCannotTakeItsNameTakesNone) {
  std::filesystem::create_directory(folder_ / "000002.png");
  const CommandResult result = piblocks(
      {"render", "--quiet", "--size", "64x36", "--fps", "10", "--to", "0.3", "-o", "%06d.png"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("000002.png"), std::string::npos) << result.err;
  EXPECT_EQ(entries(), (std::vector<std::string>{"000002.png"}));
}

}  // namespace
}  // namespace piblocks
