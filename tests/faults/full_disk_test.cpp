// A disk without room for the output: one too small by anything from a page to nearly all.
#include <fmt/format.h>
#include <sys/mount.h>

#include "faults/fault_fixture.hpp"

namespace piblocks {
namespace {

/// A file system of so many bytes; only root can make one, and not in every container.
class SmallDisk {
 public:
  SmallDisk(const std::filesystem::path& folder, long bytes) : folder_(folder) {
    const std::string size = fmt::format("size={}", bytes);
    is_there_ = ::mount("none", folder.c_str(), "tmpfs", 0, size.c_str()) == 0;
  }
  ~SmallDisk() {
    if (is_there_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool is_there() const { return is_there_; }

 private:
  std::filesystem::path folder_;
  bool is_there_ = false;
};

constexpr long kPage_bytes = 4096;

/// What tmpfs takes for the contents.
long size_on_disk(const Files& files) {
  long pages = 0;
  for (const auto& [name, contents] : files) {
    pages += (static_cast<long>(contents.size()) + kPage_bytes - 1) / kPage_bytes;
  }
  return pages * kPage_bytes;
}

TEST_P(EveryKindTest, OnAFullDiskFailsAndLeavesWhatWasThere) {
  const Files complete = undisturbed(GetParam());
  const long needed = size_on_disk(complete);
  int tried = 0;
  // Some 20 sizes from nearly nothing to one page too few.
  const long step = std::max(kPage_bytes, needed / 20 / kPage_bytes * kPage_bytes);
  for (long room = needed - kPage_bytes; room >= 0; room -= step, ++tried) {
    SCOPED_TRACE(fmt::format("{} of {} bytes", room, needed));
    const long for_old_files = kPage_bytes * static_cast<long>(complete.size());
    const SmallDisk disk(out(), std::max(kPage_bytes, for_old_files + room));
    if (!disk.is_there()) GTEST_SKIP() << "no right to mount a file system";
    const Files old = put_old_files(complete);
    const CommandResult result = run(GetParam().arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(contains(result.err, "No space left on device"));
    EXPECT_EQ(lines(result.err).size(), 1u) << result.err;
    EXPECT_TRUE(files() == old);
  }
  const SmallDisk disk(out(), needed + size_on_disk(complete) + 16 * kPage_bytes);
  put_old_files(complete);
  EXPECT_EQ(run(GetParam().arguments).exit_code, 0);
  EXPECT_TRUE(files() == complete);
  fmt::print("{} sizes were too small\n", tried);
}
/// Large enough for the disk to be full in the header, between frames, or at the index.
const OutputKind kLongMp4{
    "LongMp4",
    {"render", "--quiet", "--size", "640x360", "--crf", "1", "--to", "2", "-o", "a.mp4"}};
const OutputKind kLongLog{"LongLog", {"log", "--digits", "4", "-o", "a.csv"}};
INSTANTIATE_TEST_SUITE_P(FullDiskLong, EveryKindTest, testing::Values(kLongMp4, kLongLog), name_of);
INSTANTIATE_TEST_SUITE_P(FullDisk, EveryKindTest, testing::ValuesIn(every_kind()), name_of);

}  // namespace
}  // namespace piblocks
