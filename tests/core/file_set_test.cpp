// Files that take their names together.
#include "core/file_set.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <fstream>
#include <map>
#include <string_view>
#include <thread>
#include <vector>

#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

using testing_support::file_contents;
using testing_support::TemporaryFolder;
using Files = std::map<std::string, std::string>;

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

class FileSetTest : public testing::Test {
 protected:
  Files files() const {
    Files files;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      files[entry.path().filename()] =
          entry.is_directory() ? "folder" : file_contents(entry.path());
    }
    return files;
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  /// Begins a set where SIGKILL has left these files in the folder of another.
  void begin_after_dead_set(const Files& left) const {
    const fs::path dead = FileSet(folder_.path(), "set").temporary_folder();
    for (const auto& [name, text] : left) {
      fs::create_directories((dead / name).parent_path());
      std::ofstream(dead / name) << text;
    }
    const FileSet next(folder_.path(), "set");
  }

  TemporaryFolder folder_;
};

TEST_F(FileSetTest, ReplacesAndRemovesTogether) {
  for (const char* name : {"1", "2", "3", "other"}) write(name, "old");
  {
    FileSet files(folder_.path(), "set");
    files.add("1", bytes_of("new"));
    files.remove("3");
  }
  EXPECT_EQ(files(), (Files{{"1", "old"}, {"2", "old"}, {"3", "old"}, {"other", "old"}}));
  FileSet set(folder_.path(), "set");
  set.add("1", bytes_of("new"));
  set.add("2", bytes_of("new"));
  set.remove("3");
  set.commit();
  EXPECT_EQ(files(), (Files{{"1", "new"}, {"2", "new"}, {"other", "old"}}));
}

/// A file that is gone stops the renaming half-way.
TEST_F(FileSetTest, TakesAllNamesBackWhereOneCannotBeTaken) {
  write("1", "old");
  write("3", "old");
  FileSet set(folder_.path(), "set");
  for (const char* name : {"1", "2"}) set.add(name, bytes_of("new"));
  set.remove("3");
  fs::remove(set.temporary_folder() / "new/2");
  EXPECT_THROW(set.commit(), IoError);
  Files left = files();
  std::erase_if(left, [](const auto& file) { return file.second == "folder"; });
  EXPECT_EQ(left, (Files{{"1", "old"}, {"3", "old"}}));
}

/// A set that is kept to be resumed, and could not take its names, is not half in place.
TEST_F(FileSetTest, KeepsWhatItCouldNotName) {
  const auto unfinished = [&](const std::string& job) {
    return Resumption{.job = job, .is_wanted = true};
  };
  {
    FileSet set(folder_.path(), "set", Unfinished::Sharing::exclusive, unfinished("name: one\n"));
    const auto bytes = std::vector<std::uint8_t>(3, 'x');
    set.add("a", bytes);
    set.add("b", bytes);
    std::filesystem::remove(set.temporary_folder() / "new" / "b");
    EXPECT_THROW(set.commit(), IoError);
  }
  EXPECT_THROW(
      FileSet(folder_.path(), "set", Unfinished::Sharing::exclusive, unfinished("name: two\n")),
      UsageError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a"));
  {
    const FileSet again(folder_.path(), "set", Unfinished::Sharing::exclusive,
                        unfinished("name: one\n"));
    EXPECT_TRUE(std::filesystem::exists(again.temporary_folder() / "new" / "a"));
  }
  const FileSet other(folder_.path(), "set");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a"));
}

TEST_F(FileSetTest, KeepsPermissions) {
  write("1", "old");
  fs::permissions(folder_ / "1", fs::perms(0600));
  FileSet set(folder_.path(), "set");
  set.add("1", bytes_of("new"));
  set.commit();
  EXPECT_EQ(fs::status(folder_ / "1").permissions(), fs::perms(0600));
}

TEST_F(FileSetTest, ReplacesNoLinkAndNoFolder) {
  write("target", "old");
  fs::create_symlink("target", folder_ / "link");
  fs::create_directory(folder_ / "folder");
  FileSet set(folder_.path(), "set");
  EXPECT_THROW(set.add("link"), IoError);
  EXPECT_THROW(set.add("folder"), IoError);
  EXPECT_THROW(set.remove("link"), IoError);
}

TEST_F(FileSetTest, HasNoRivalUnlessThatIsAllowed) {
  const FileSet first(folder_.path(), "set");
  EXPECT_THROW(FileSet(folder_.path(), "set"), UsageError);
  EXPECT_NO_THROW(FileSet(folder_.path(), "another"));
  EXPECT_NO_THROW(FileSet(folder_.path(), "set", Unfinished::Sharing::shared));
  EXPECT_TRUE(fs::exists(first.temporary_folder()));
}

/// Each takes what others have just made, and not yet locked, for abandoned.
TEST_F(FileSetTest, RivalsThatStartTogetherAllGetAFolder) {
  std::vector<std::jthread> rivals;
  for (int i = 0; i < 4; ++i) {
    rivals.emplace_back([this] {
      for (int turn = 0; turn < 300; ++turn) {
        EXPECT_NO_THROW(FileSet(folder_.path(), "set", Unfinished::Sharing::shared));
      }
    });
  }
  rivals.clear();
  EXPECT_EQ(files(), Files{});
}

TEST_F(FileSetTest, CompletesWhatAKilledProcessHadBegunToRename) {
  write("1", "new");
  write("3", "old");
  begin_after_dead_set({{"old/1", "old"}, {"new/2", "new"}, {"new/3", "new"}});
  EXPECT_EQ(files(), (Files{{"1", "new"}, {"2", "new"}, {"3", "new"}}));
}

TEST_F(FileSetTest, RemovesWhatAKilledProcessHadOnlyToRemove) {
  write("1", "new");
  begin_after_dead_set({{"old/1", "old"}});
  EXPECT_EQ(files(), (Files{{"1", "new"}}));
}

/// Before the first renaming the old files are still in place, and the new ones may be incomplete.
TEST_F(FileSetTest, DropsWhatAKilledProcessHadNotBegunToRename) {
  write("1", "old");
  begin_after_dead_set({{"new/1", "ne"}});
  EXPECT_EQ(files(), (Files{{"1", "old"}}));
}

}  // namespace
}  // namespace piblocks
