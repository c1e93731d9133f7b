// Signals while the program works.
#include <fcntl.h>
#include <sys/stat.h>

#include <csignal>

#include "cli/cli_fixture.hpp"
#include "core/descriptor.hpp"

namespace piblocks {
namespace {

/// Hours of work, of which the first output is there soon.
const Arguments kLong{"render", "--quiet", "--size", "320x180", "--fps", "60", "--to", "9999"};

class InterruptionTest : public CliFixture {
 protected:
  /// A command that waits ends by the signal, and leaves the folder as it was.
  void expect_left(const Arguments& arguments, int signal) const {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const std::vector<std::string> before = entries();
    RunningCommand command(arguments, {.folder = folder_.path()});
    EXPECT_FALSE(wait_until([&] { return command.has_ended(); }, std::chrono::milliseconds(500)));
    command.send(signal);
    EXPECT_TRUE(wait_until([&] { return command.has_ended(); }, std::chrono::seconds(5)));
    const CommandResult result = command.wait();
    EXPECT_EQ(result.exit_code, -signal);
    EXPECT_EQ(result.err, "piblocks: interrupted\n");
    EXPECT_EQ(entries(), before);
  }
};

struct Interruption {
  std::string name;
  Arguments arguments;
  int signal;
};

std::ostream& operator<<(std::ostream& out, const Interruption& interruption) {
  return out << interruption.name;
}

class InterruptionsTest : public CliFixture, public testing::WithParamInterface<Interruption> {};

TEST_P(InterruptionsTest, LeaveNothingBehind) {
  RunningCommand command(GetParam().arguments, {.folder = folder_.path()});
  ASSERT_TRUE(wait_until([&] { return !folder_.is_empty(); }));
  command.send(GetParam().signal);
  const CommandResult result = command.wait();
  EXPECT_EQ(result.exit_code, -GetParam().signal) << "a shell would go on with its loop";
  EXPECT_EQ(result.err, "piblocks: " + GetParam().arguments.front() + ": interrupted\n");
  EXPECT_EQ(entries(), Names{});
}
INSTANTIATE_TEST_SUITE_P(
    Signals, InterruptionsTest,
    testing::Values(
        Interruption{"IntMp4", kLong + Arguments{"-o", "new/a.mp4"}, SIGINT},
        Interruption{"TermMp4", kLong + Arguments{"-o", "a.mp4"}, SIGTERM},
        Interruption{"HangupMp4", kLong + Arguments{"-o", "a.mp4"}, SIGHUP},
        Interruption{"IntPng", kLong + Arguments{"-o", "new/%06d.png"}, SIGINT},
        Interruption{"TermPng", kLong + Arguments{"-o", "%06d.png"}, SIGTERM},
        Interruption{"IntMov", kLong + Arguments{"-o", "a.mov"}, SIGINT},
        Interruption{"IntTransparentMov", kLong + Arguments{"--transparent", "-o", "a.mov"},
                     SIGINT},
        Interruption{"TermWebm", kLong + Arguments{"-o", "new/a.webm"}, SIGTERM},
        Interruption{"IntApng", kLong + Arguments{"-o", "a.apng"}, SIGINT},
        Interruption{"IntWebp", kLong + Arguments{"-o", "a.webp"}, SIGINT},
        Interruption{"IntGif",
                     {"render", "--quiet", "--size", "320x180", "--fps", "50", "--to", "9999", "-o",
                      "a.gif"},
                     SIGINT},
        Interruption{"IntY4m", kLong + Arguments{"-o", "a.y4m"}, SIGINT},
        Interruption{"IntPage", kLong + Arguments{"-o", "a.html"}, SIGINT},
        Interruption{"TermBundle", kLong + Arguments{"--bundle", "new/talk", "-o", "a.mp4"},
                     SIGTERM},
        Interruption{"IntWav", kLong + Arguments{"-o", "a.wav"}, SIGINT},
        Interruption{
            "IntSheet", {"sheet", "--frames", "200", "--size", "3840x2160", "-o", "a.pdf"}, SIGINT},
        Interruption{
            "IntStill", {"still", "--at", "1", "--size", "8192x4096", "-o", "a.png"}, SIGINT},
        Interruption{
            "IntLog", {"log", "--digits", "12", "--limit", "1e11", "-o", "a.csv"}, SIGINT}),
    [](const auto& test) { return test.param.name; });

TEST_F(InterruptionTest, AnOldFileSurvives) {
  write("a.mp4", "old");
  RunningCommand command(kLong + Arguments{"-o", "a.mp4"}, {.folder = folder_.path()});
  ASSERT_TRUE(wait_until([&] { return entries().size() == 2; }));
  command.send(SIGINT);
  EXPECT_EQ(command.wait().exit_code, -SIGINT);
  EXPECT_EQ(contents("a.mp4"), "old");
  EXPECT_EQ(entries(), (Names{"a.mp4"}));
}

/// A reader that takes nothing holds the program in a write; the second signal does not wait.
TEST_F(InterruptionTest, ASecondSignalEndsItAtOnce) {
  RunningCommand command(kLong + Arguments{"-o", "-"}, {.folder = folder_.path()});
  EXPECT_FALSE(wait_until([&] { return command.has_ended(); }, std::chrono::milliseconds(500)));
  command.send(SIGINT);
  EXPECT_FALSE(wait_until([&] { return command.has_ended(); }, std::chrono::milliseconds(500)));
  command.send(SIGINT);
  EXPECT_TRUE(wait_until([&] { return command.has_ended(); }));
  EXPECT_EQ(command.wait().exit_code, -SIGINT);
}

/// Nobody writes to the pipe that the program reads. It is asked only after it has come that far.
class PipeTest : public InterruptionTest, public testing::WithParamInterface<const char*> {};

TEST_P(PipeTest, ThatNobodyWritesToCanBeLeft) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  expect_left(split(GetParam(), ' '), SIGINT);
}
INSTANTIATE_TEST_SUITE_P(AsInput, PipeTest,
                         testing::Values("render pipe -o new/a.mp4", "still pipe --at 1 -o a.png",
                                         "golden record pipe --dir new", "count pipe",
                                         "log pipe -o a.csv", "render --logo pipe -o new/a.mp4",
                                         "render --logo pipe -o a.html",
                                         "render --logo pipe --bundle new -o a.mp4",
                                         "still --logo pipe --at 1 -o a.png",
                                         "sheet --logo pipe -o a.pdf", "compare pipe pipe",
                                         "golden check pipe --dir ."));

/// A writer that has opened the pipe holds the program in a read. Both sides of a comparison are
/// read at a time, by threads of their own.
TEST_F(InterruptionTest, APipeThatStaysSilentCanBeLeft) {
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "a.png"});
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const Descriptor writer(::open((folder_ / "pipe").c_str(), O_RDWR | O_CLOEXEC));
  for (const int signal : {SIGTERM, SIGINT}) {
    expect_left({"count", "pipe"}, signal);
    expect_left({"still", "--logo", "pipe", "--at", "1", "-o", "b.png"}, signal);
    expect_left({"compare", "pipe", "a.png"}, signal);
    expect_left({"compare", "a.png", "pipe"}, signal);
  }
}

/// Signals that mean something else, from a cluster or from anybody, do not make it deaf.
TEST_F(InterruptionTest, OtherSignalsChangeNothing) {
  RunningCommand command(kLong + Arguments{"-o", "a.mp4"}, {.folder = folder_.path()});
  ASSERT_TRUE(wait_until([&] { return !folder_.is_empty(); }));
  for (const int signal : {SIGUSR1, SIGUSR2, SIGURG, SIGUSR1}) {
    command.send(signal);
    EXPECT_FALSE(wait_until([&] { return command.has_ended(); }, std::chrono::milliseconds(50)));
  }
  command.send(SIGTERM);
  EXPECT_TRUE(wait_until([&] { return command.has_ended(); }, std::chrono::seconds(10)));
  const CommandResult result = command.wait();
  EXPECT_EQ(result.exit_code, -SIGTERM);
  EXPECT_EQ(result.err, "piblocks: render: interrupted\n");
  EXPECT_EQ(entries(), Names{});
}

/// As nohup starts it.
TEST_F(InterruptionTest, AnIgnoredSignalStaysIgnored) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  RunningCommand command(kLong + Arguments{"-o", "a.mp4"}, {.folder = folder_.path()});
  std::signal(SIGHUP, before);
  ASSERT_TRUE(wait_until([&] { return !folder_.is_empty(); }));
  command.send(SIGHUP);
  EXPECT_FALSE(wait_until([&] { return command.has_ended(); }, std::chrono::milliseconds(300)));
  command.send(SIGINT);
  EXPECT_EQ(command.wait().exit_code, -SIGINT);
}

}  // namespace
}  // namespace piblocks
