// Outputs that fail while they are written: exit code 1, a message, nothing left behind.
#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using FailureTest = CliFixture;

Arguments words(const std::string& line) { return split(line, ' '); }

class FullDiskTest : public CliFixture, public testing::WithParamInterface<const char*> {};

TEST_P(FullDiskTest, IsReported) {
  const CommandResult result = piblocks(words(GetParam()), {.out_file = "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(result.err.starts_with("piblocks: ")) << result.err;
  EXPECT_TRUE(contains(result.err, "standard output"));
  EXPECT_EQ(lines(result.err).size(), 1u) << result.err;
}
INSTANTIATE_TEST_SUITE_P(StandardOutput, FullDiskTest,
                         testing::Values("--help", "--version", "info", "render --help",
                                         "count --digits 3", "state --at 1", "log --limit 2",
                                         "log --digits 6", "still --at 1 --size 64x36 -o -",
                                         "render --quiet --size 64x36 --to 1 -o -"));

struct Unread {
  const char* command;
  int exit_code = 1;
  const char* message = "piblocks: output: cannot write 'standard output': Broken pipe\n";
};

std::ostream& operator<<(std::ostream& out, const Unread& unread) { return out << unread.command; }

class ClosedPipeTest : public CliFixture, public testing::WithParamInterface<Unread> {};

/// Whoever has read enough of a text closes the pipe; bytes are needed whole.
TEST_P(ClosedPipeTest, IsAFailureUnlessItWasAText) {
  RunningCommand command(words(GetParam().command), {.folder = folder_.path()});
  command.close_output_after_one_byte();
  const CommandResult result = command.wait();
  EXPECT_EQ(result.exit_code, GetParam().exit_code);
  EXPECT_EQ(result.err, GetParam().message);
}
INSTANTIATE_TEST_SUITE_P(StandardOutput, ClosedPipeTest,
                         testing::Values(Unread{"log --digits 8 --format npy"},
                                         Unread{"render --quiet --size 320x180 --jobs 3 -o -"},
                                         Unread{"log --digits 8", 0, ""},
                                         Unread{"log --digits 8 --format jsonl", 0, ""},
                                         Unread{"count --digits 100000", 0, ""}));

/// The exit code tells the verdict, also to a reader of the first line alone.
TEST_F(FailureTest, AComparisonWithoutAReaderKeepsItsVerdict) {
  for (const auto& [name, to] : {std::pair{"a", "9"}, {"b", "10"}}) {
    output_of({"render", "--quiet", "--size", "64x36", "--fps", "3", "--from", "1", "--speed",
               "1/3", "--to", to, "--theme", to == std::string("9") ? "article" : "dark", "-o",
               std::string(name) + "/%03d.png"});
  }
  RunningCommand command({"compare", "a", "b"}, {.folder = folder_.path()});
  command.close_output_after_one_byte();
  const CommandResult result = command.wait();
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_EQ(result.err, "");
}

TEST_F(FailureTest, AVerdictThatCannotBePrintedIsNone) {
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "a.png"});
  write("scene.toml", "[time]\nto = 1\n[golden]\nsize = [64, 36]\n");
  output_of({"golden", "record", "scene.toml", "--dir", "golden"});
  for (const Arguments& arguments :
       {Arguments{"compare", "a.png", "a.png"},
        Arguments{"golden", "check", "scene.toml", "--dir", "golden"},
        Arguments{"golden", "approve", "scene.toml", "--dir", "golden"}}) {
    const CommandResult result = piblocks(arguments, {.out_file = "/dev/full"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err,
              "piblocks: output: cannot write 'standard output': No space left on device\n");
  }
}

TEST_F(FailureTest, ThatTheEngineCannotRepresentIsNoNumber) {
  // JSON has no infinity.
  EXPECT_TRUE(contains(refusal({"state", "--mass-ratio", "1e-700", "--at", "last"}, 1),
                       "range of a double"));
}

TEST_F(FailureTest, AFrameThatCannotTakeItsNameTakesNone) {
  std::filesystem::create_directory(folder_ / "000002.png");
  const Arguments render{"render", "--quiet", "--size", "64x36", "--fps",
                         "10",     "--to",    "0.3",    "-o",    "%06d.png"};
  EXPECT_TRUE(contains(refusal(render, 1), "000002.png"));
}

}  // namespace
}  // namespace piblocks
