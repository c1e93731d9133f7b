// The benchmark's reading of the program's profile.
#include "speed/profile.hpp"

#include <gtest/gtest.h>

namespace piblocks::benchmark {
namespace {

TEST(BenchmarkProfile, HasEveryStageInItsOrder) {
  const auto stages = parse_profile(
      "  compose      0.012 s   0.014 ms/frame   0.8 %\n"
      "  paint        0.031 s   0.037 ms/frame   2.1 %\n"
      "  total       12.500 s  15.024 ms/frame 100.0 %\n");
  ASSERT_EQ(stages.size(), 3U);
  EXPECT_EQ(stages[0].stage, "compose");
  EXPECT_DOUBLE_EQ(stages[0].cpu_seconds, 0.012);
  EXPECT_EQ(stages[1].stage, "paint");
  EXPECT_DOUBLE_EQ(stages[1].cpu_seconds, 0.031);
  EXPECT_EQ(stages[2].stage, "total");
  EXPECT_DOUBLE_EQ(stages[2].cpu_seconds, 12.5);
}

TEST(BenchmarkProfile, IsFoundAmongOtherLines) {
  const auto stages = parse_profile(
      "pi-3.mp4: 832 frames in 0:01\n"
      "processor time:\n"
      "  encode       2.000 s   2.404 ms/frame  80.0 %\n"
      "\n"
      "note: 2 threads\n");
  ASSERT_EQ(stages.size(), 1U);
  EXPECT_EQ(stages[0].stage, "encode");
}

TEST(BenchmarkProfile, IsEmptyForLinesOfAnotherForm) {
  EXPECT_TRUE(parse_profile("").empty());
  EXPECT_TRUE(parse_profile("paint 0.031 s 0.037 ms/frame 2.1 %\n").empty());
  EXPECT_TRUE(parse_profile("  paint 0.031 s 0.037 ms/frame\n").empty());
  EXPECT_TRUE(parse_profile("  paint 31 ms 0.037 ms/frame 2.1 %\n").empty());
  EXPECT_TRUE(parse_profile("  paint fast s 0.037 ms/frame 2.1 %\n").empty());
}

}  // namespace
}  // namespace piblocks::benchmark
