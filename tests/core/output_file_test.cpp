#include "core/output_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>
#include <string>

#include "support/message_of.hpp"
#include "support/ordinary_user.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

using testing_support::file_contents;
using testing_support::TemporaryFolder;

class OutputFileTest : public testing::Test {
 protected:
  static void write(const fs::path& path, const std::string& text) {
    OutputFile file(path);
    file.write(text);
    file.finish();
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

  TemporaryFolder folder_;
};

TEST_F(OutputFileTest, AppearsOnlyWhenFinished) {
  const fs::path path = folder_ / "out.txt";
  OutputFile file(path);
  file.write("hello");
  EXPECT_FALSE(fs::exists(path));
  file.finish();
  EXPECT_EQ(file_contents(path), "hello");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFileTest, LeavesNoTraceWhenAbandoned) {
  { OutputFile(folder_ / "a/b/out.txt").write("half"); }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(OutputFileTest, KeepsTheOldFileWhenAbandoned) {
  const fs::path path = folder_ / "out.txt";
  std::ofstream(path) << "old";
  { OutputFile(path).write("new"); }
  EXPECT_EQ(file_contents(path), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFileTest, MakesMissingFoldersAndKeepsThem) {
  write(folder_ / "a/b/out.txt", "");
  EXPECT_TRUE(fs::exists(folder_ / "a/b/out.txt"));
}

TEST_F(OutputFileTest, HasThePermissionsOfAnOrdinaryFile) {
  write(folder_ / "out.txt", "");
  std::ofstream(folder_ / "plain.txt") << "x";
  EXPECT_EQ(fs::status(folder_ / "out.txt").permissions(),
            fs::status(folder_ / "plain.txt").permissions());
}

TEST_F(OutputFileTest, HasThePermissionsOfTheFileThatItReplaces) {
  const fs::path path = folder_ / "out.txt";
  for (const auto permissions : {fs::perms(0600), fs::perms(0664), fs::perms(0640)}) {
    std::ofstream(path) << "old";
    fs::permissions(path, permissions);
    write(path, "new");
    EXPECT_EQ(fs::status(path).permissions(), permissions);
    EXPECT_EQ(file_contents(path), "new");
  }
}

TEST_F(OutputFileTest, ReplacesNoFileThatMayNotBeWritten) {
  const fs::path path = folder_ / "out.txt";
  std::ofstream(path) << "old";
  fs::permissions(path, fs::perms(0444));
  fs::permissions(folder_.path(), fs::perms::all);
  {
    const testing_support::OrdinaryUser user;
    EXPECT_THROW(OutputFile{path}, UsageError);
  }
  EXPECT_EQ(file_contents(path), "old");
}

TEST_F(OutputFileTest, ReplacesWhatALinkPointsTo) {
  fs::create_directory(folder_ / "there");
  fs::create_symlink("there/to", folder_ / "from");
  fs::create_symlink("from", folder_ / "first");
  for (const char* text : {"new", "newer"}) {
    write(folder_ / "first", text);
    EXPECT_EQ(file_contents(folder_ / "there/to"), text);
  }
  EXPECT_TRUE(fs::is_symlink(folder_ / "first"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "from"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "there"), {}), 1);
  fs::create_symlink("round", folder_ / "round");
  EXPECT_THROW(OutputFile{folder_ / "round"}, UsageError);
}

/// Another thread of a program that uses the library may make a file just then.
TEST_F(OutputFileTest, LeavesTheMaskOfTheProcessAlone) {
  const mode_t before = ::umask(027);
  write(folder_ / "out.txt", "");
  EXPECT_EQ(::umask(before), 027U);
  EXPECT_EQ(fs::status(folder_ / "out.txt").permissions(), fs::perms(0640));
}

TEST_F(OutputFileTest, NamesWhatCannotBeOpened) {
  fs::create_directory(folder_ / "taken");
  EXPECT_THROW(OutputFile{folder_ / "taken"}, UsageError);
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THROW(OutputFile{folder_ / "file/below.txt"}, UsageError);
  EXPECT_THROW(OutputFile{"/dev/null"}, UsageError);
  EXPECT_THROW(OutputFile{"/proc/no/such.txt"}, UsageError);
  EXPECT_THROW(OutputFile{""}, UsageError);
}

TEST_F(OutputFileTest, NamesAFolderThatMayNotBeSearched) {
  fs::permissions(folder_.path(), fs::perms::none);
  for (const char* name : {"out.txt", "a/out.txt", "a/b/out.txt"}) {
    const testing_support::OrdinaryUser user;
    EXPECT_THROW(OutputFile{folder_ / name}, UsageError) << name;
  }
  fs::permissions(folder_.path(), fs::perms::owner_all);
}

TEST_F(OutputFileTest, TakesTheLongestNameThatThereIs) {
  const std::string longest(255, 'x');
  {
    OutputFile file(folder_ / longest);
    OutputFile other(folder_ / (longest.substr(1) + 'y'));  // begins alike
    file.write("hello");
    file.finish();
  }
  EXPECT_EQ(file_contents(folder_ / longest), "hello");
  EXPECT_EQ(entries(), 1u);
  EXPECT_THROW(OutputFile(folder_ / (longest + 'x')), UsageError);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFileTest, TheNameOfAFolderIsRefusedBeforeAnythingIsMade) {
  for (const std::string name : {"new/", "new/.", "new/..", ".", ".."}) {
    EXPECT_THROW(OutputFile(folder_ / name), UsageError) << name;
    EXPECT_EQ(entries(), 0u) << name;
  }
}

TEST_F(OutputFileTest, AFileThatHasLostItsNameGetsNoOther) {
  const fs::path path = folder_ / "out.txt";
  const Descriptor open_file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  fs::remove(path);
  EXPECT_THROW(OutputFile("/proc/self/fd/" + std::to_string(open_file.get())), UsageError);
  EXPECT_EQ(entries(), 0u);
}

TEST_F(OutputFileTest, AFileThatIsOpenGoesByItsNumber) {
  const fs::path path = folder_ / "out.txt";
  const Descriptor open_file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  write("/proc/self/fd/" + std::to_string(open_file.get()), "hello");
  EXPECT_EQ(file_contents(path), "hello");
}

TEST_F(OutputFileTest, APipeIsNamedAsItWasGiven) {
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const Descriptor out(pipe[0]);
  const Descriptor in(pipe[1]);
  const std::string name = "/proc/self/fd/" + std::to_string(in.get());
  EXPECT_EQ(testing_support::message_of<UsageError>([&] { OutputFile{name}; }),
            "output: cannot open '" + name + "': not a file");
}

}  // namespace
}  // namespace piblocks
