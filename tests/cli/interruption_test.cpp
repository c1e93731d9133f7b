// Signals while the program works.
#include <csignal>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using InterruptionTest = CliFixture;

/// Hours of work, of which the first output is there soon.
const Arguments kLong{"render", "--quiet", "--size", "320x180", "--fps", "60", "--to", "9999"};

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
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "piblocks: " + GetParam().arguments.front() + ": interrupted\n");
  EXPECT_EQ(entries(), (std::vector<std::string>{}));
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
  EXPECT_EQ(command.wait().exit_code, 1);
  EXPECT_EQ(contents("a.mp4"), "old");
  EXPECT_EQ(entries(), (std::vector<std::string>{"a.mp4"}));
}

/// A reader that takes nothing holds the program in a write; the second signal does not wait.
TEST_F(InterruptionTest, ASecondSignalEndsItAtOnce) {
  RunningCommand command(kLong + Arguments{"-o", "-"}, {.folder = folder_.path()});
  EXPECT_FALSE(wait_until([&] { return command.has_ended(); }, std::chrono::milliseconds(500)));
  command.send(SIGINT);
  EXPECT_FALSE(wait_until([&] { return command.has_ended(); }, std::chrono::milliseconds(500)));
  command.send(SIGINT);
  EXPECT_TRUE(wait_until([&] { return command.has_ended(); }));
  EXPECT_EQ(command.wait().exit_code, 1);
}

}  // namespace
}  // namespace piblocks
