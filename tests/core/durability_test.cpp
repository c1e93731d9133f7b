// Syncing and opening folders, by the calls of this build's system.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "core/descriptor.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {

class DurabilityTest : public testing::Test {
 protected:
  testing_support::TemporaryFolder folder_;
};

TEST_F(DurabilityTest, SyncsFilesAndFolders) {
  for (const char* name : {"a", "b"}) std::ofstream(folder_ / name) << name;
  const Descriptor file(::open((folder_ / "a").c_str(), O_WRONLY | O_CLOEXEC));
  const Descriptor folder(::open(folder_.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  EXPECT_EQ(sync_file(file.get()), 0);
  EXPECT_EQ(sync_file(folder.get()), 0);
  EXPECT_EQ(sync_files(folder_.path(), folder.get()), 0);
  EXPECT_EQ(sync_file(-1), EBADF);
  EXPECT_NE(sync_files(folder_ / "none", -1), 0);
}

TEST_F(DurabilityTest, RenamesInAnOpenFolder) {
  std::ofstream(folder_ / "old") << "text";
  const Descriptor folder = open_to_rename_in(folder_.path());
  ASSERT_TRUE(folder.is_open());
  EXPECT_EQ(::renameat(folder.get(), "old", folder.get(), "new"), 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "new"));
}

TEST_F(DurabilityTest, SaysWhyAFolderCannotBeOpened) {
  std::ofstream(folder_ / "file") << "text";
  EXPECT_FALSE(open_to_rename_in(folder_ / "none").is_open());
  EXPECT_EQ(errno, ENOENT);
  EXPECT_FALSE(open_to_rename_in(folder_ / "file").is_open());
  EXPECT_EQ(errno, ENOTDIR);
}

}  // namespace
}  // namespace piblocks
