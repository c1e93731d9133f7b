// Outputs that go away or refuse while they are written.
#include <fcntl.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "core/descriptor.hpp"
#include "faults/fault_fixture.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

using BrokenOutputTest = FaultFixture;

/// @return whether the file system knows folders that not even root can change.
bool set_immutable(const fs::path& folder, bool immutable) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  int flags = 0;
  if (::ioctl(descriptor.get(), FS_IOC_GETFLAGS, &flags) != 0) return false;
  flags = immutable ? flags | FS_IMMUTABLE_FL : flags & ~FS_IMMUTABLE_FL;
  return ::ioctl(descriptor.get(), FS_IOC_SETFLAGS, &flags) == 0;
}

class BrokenFolderTest : public EveryKindTest {
 protected:
  /// A run that has begun its output does something to the folder, and goes on.
  CommandResult disturb(const std::function<void()>& disturbance) const {
    CommandOptions options = with_fault("stop 1");
    options.folder = out();
    RunningCommand command(GetParam().arguments, options);
    EXPECT_TRUE(testing_support::wait_until([&] { return command.has_stopped(); }));
    disturbance();
    command.send(SIGCONT);
    return command.wait();
  }
};

/// What may not be removed stays, under a name that says what it is.
TEST_P(BrokenFolderTest, ThatMayNoLongerBeWrittenKeepsTheOldFiles) {
  if (!kHasFaults) GTEST_SKIP() << "a sanitizer replaces malloc() itself";
  const Files complete = undisturbed(GetParam());
  if (!set_immutable(out(), true)) GTEST_SKIP() << "no right to make a folder immutable";
  set_immutable(out(), false);
  const Files old = put_old_files(complete);
  const CommandResult result = disturb([&] { set_immutable(out(), true); });
  set_immutable(out(), false);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err, "Operation not permitted"));
  EXPECT_TRUE(finished() == old);
  EXPECT_EQ(run(GetParam().arguments).exit_code, 0);
  EXPECT_TRUE(files() == complete);
}

TEST_P(BrokenFolderTest, ThatIsRemovedIsAnError) {
  if (!kHasFaults) GTEST_SKIP() << "a sanitizer replaces malloc() itself";
  undisturbed(GetParam());
  const CommandResult result = disturb([&] { fs::remove_all(out()); });
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err, "No such file or directory"));
  EXPECT_EQ(lines(result.err).size(), 1u) << result.err;
}
INSTANTIATE_TEST_SUITE_P(Every, BrokenFolderTest, testing::ValuesIn(every_kind()), name_of);

class StreamTest : public EveryKindTest {};

/// The output must not take the number of a stream, and what is said to people with it.
TEST_P(StreamTest, ThatIsClosedDoesNotSpoilTheOutput) {
  const Files complete = undisturbed(GetParam());
  Arguments loud = GetParam().arguments;
  std::erase(loud, "--quiet");
  const CommandResult result = run(loud, {.closed = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(files() == complete);
}
INSTANTIATE_TEST_SUITE_P(Every, StreamTest, testing::ValuesIn(every_kind()), name_of);

TEST_F(BrokenOutputTest, ClosedStandardOutputIsAnError) {
  const CommandResult result = run(small_render({"-o", "-"}), {.closed = {STDOUT_FILENO}});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "piblocks: output: cannot write 'standard output': Bad file descriptor\n");
}

/// Lets the files of the programs that are started grow to so many bytes only, as ulimit -f does.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

/// The system would end the program by SIGXFSZ.
TEST_F(BrokenOutputTest, OfLimitedSizeIsAnError) {
  const std::string file = in() / "out.y4m";
  const FileSizeLimit limit(100'000);
  const CommandResult result = run(small_render({"-o", "-"}), {.out_file = file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "piblocks: output: cannot write 'standard output': File too large\n");
}

TEST_F(BrokenOutputTest, ATerminalThatIsClosedDoesNotEndTheWork) {
  if (!testing_support::has_pseudo_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  Arguments loud = small_render({"-o", "a.mp4"});
  std::erase(loud, "--quiet");
  RunningCommand command(loud, {.folder = out(), .err_is_terminal = true});
  command.close_errors();
  EXPECT_EQ(command.wait().exit_code, 0);
  EXPECT_EQ(names(files()), std::set<std::string>{"a.mp4"});
}

}  // namespace
}  // namespace piblocks
