// How much of the processors' time control groups grant, told by the texts of Linux.
#include "core/processors.hpp"

#include <gtest/gtest.h>

#include <map>

namespace piblocks {
namespace {

using Files = std::map<std::string, std::string>;

std::optional<double> granted(std::string_view groups, std::string_view mounts,
                              const Files& files) {
  return granted_processors(groups, mounts, [&](const std::string& path) {
    const auto found = files.find(path);
    return found == files.end() ? std::nullopt : std::optional(found->second);
  });
}

constexpr std::string_view kVersion2 = "31 23 0:26 / /cg rw,nosuid shared:9 - cgroup2 cgroup2 rw\n";
constexpr std::string_view kVersion1 =
    "20 1 0:9 / / rw - ext4 /dev/sda rw\n"
    "34 31 0:31 / /cg/cpuset rw - cgroup cgroup rw,cpuset\n"
    "32 31 0:29 / /cg/cpu rw - cgroup cgroup rw,cpu,cpuacct\n";

TEST(GrantedProcessors, OfTheGroupAndOfThoseThatItLiesIn) {
  EXPECT_EQ(granted("0::/a/b\n", kVersion2, {{"/cg/a/b/cpu.max", "150000 100000\n"}}), 1.5);
  EXPECT_EQ(granted("0::/a/b\n", kVersion2,
                    {{"/cg/a/b/cpu.max", "max 100000\n"}, {"/cg/a/cpu.max", "25000 50000\n"}}),
            0.5);
  EXPECT_EQ(granted("0::/a/b\n", kVersion2,
                    {{"/cg/a/b/cpu.max", "300000 100000\n"}, {"/cg/cpu.max", "200000 100000\n"}}),
            2);
  EXPECT_EQ(granted("0::/a\n", kVersion2, {{"/cg/b/cpu.max", "100000 100000\n"}}), std::nullopt);
}

TEST(GrantedProcessors, OfVersion1) {
  const std::string_view groups = "3:cpuset:/x\n2:cpu,cpuacct:/a/b\n0::/\n";
  EXPECT_EQ(granted(groups, kVersion1,
                    {{"/cg/cpu/a/b/cpu.cfs_quota_us", "-1\n"},
                     {"/cg/cpu/a/b/cpu.cfs_period_us", "100000\n"},
                     {"/cg/cpu/a/cpu.cfs_quota_us", "350000\n"},
                     {"/cg/cpu/a/cpu.cfs_period_us", "100000\n"}}),
            3.5);
  EXPECT_EQ(granted("3:cpuset:/a\n", kVersion1, {{"/cg/cpu/a/cpu.cfs_quota_us", "1000\n"}}),
            std::nullopt);
}

TEST(GrantedProcessors, SeenFromInsideAContainer) {
  const std::string_view mounts = "1 2 0:3 /docker/a /cg ro - cgroup2 cgroup rw\n";
  const Files files = {{"/cg/cpu.max", "100000 100000\n"}, {"/cg/b/cpu.max", "50000 100000\n"}};
  EXPECT_EQ(granted("0::/docker/a\n", mounts, files), 1);
  EXPECT_EQ(granted("0::/docker/a/b\n", mounts, files), 0.5);
  EXPECT_EQ(granted("0::/docker/ab\n", mounts, files), 1) << "another group";
  EXPECT_EQ(granted("0::/\n", mounts, files), 1) << "a namespace of its own";
  EXPECT_EQ(granted("0::/../../x\n", mounts, files), 1) << "moved out of it";
}

TEST(GrantedProcessors, OfTextsThatSayNothing) {
  const Files odd = {{"/cg/cpu.max", ""}};
  for (const char* text : {"", "\n", "max\n", "100000\n", "0 100000\n", "100000 0\n", "-5 100000\n",
                           "x y\n", "99999999999999999999 100000\n"}) {
    EXPECT_EQ(granted("0::/\n", kVersion2, {{"/cg/cpu.max", text}}), std::nullopt) << text;
  }
  for (const char* groups : {"", "0", "0:", "0::", "::", "\n\n"}) {
    EXPECT_EQ(granted(groups, kVersion2, odd), std::nullopt) << groups;
  }
  for (const char* mounts : {"", "a b - cgroup2", "1 2 3 / /cg - cgroup2", "- - - - - - - -"}) {
    EXPECT_EQ(granted("0::/\n", mounts, odd), std::nullopt) << mounts;
  }
}

TEST(ProcessorCount, IsAtLeastOne) { EXPECT_GE(processor_count(), 1); }

}  // namespace
}  // namespace piblocks
