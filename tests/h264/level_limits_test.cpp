#include <gtest/gtest.h>

#include "h264/levels.hpp"

namespace piblocks::h264 {
namespace {

bool fits(int width_px, int height_px, std::int64_t numerator = 1, std::int64_t denominator = 1) {
  return level_problem(width_px, height_px, {numerator, denominator}).empty();
}

/// Levels of table A-1, from 1 to 6.2: a picture of MaxFS macroblocks at their rate.
TEST(LevelLimits, AreThoseOfTheHighestLevel) {
  EXPECT_TRUE(fits(8192, 4352));  // 512 x 272 = 139,264 macroblocks
  EXPECT_FALSE(fits(8192, 4353));
  EXPECT_FALSE(fits(8193, 4352));
  EXPECT_TRUE(fits(16, 16, 16'711'680));
  EXPECT_FALSE(fits(16, 16, 16'711'681));
  EXPECT_TRUE(fits(8192, 4352, 120));
  EXPECT_FALSE(fits(8192, 4352, 120001, 1000));
  EXPECT_TRUE(fits(1, 1, 2147483647, 2147483647));
}

/// Sqrt(8 x 139,264) = 1055.5 macroblocks.
TEST(LevelLimits, NoSideIsTooLong) {
  EXPECT_EQ(kMaxSide_mb, 1055);
  EXPECT_TRUE(fits(16880, 16));
  EXPECT_FALSE(fits(16881, 16));
  EXPECT_TRUE(fits(16, 16880));
  EXPECT_FALSE(fits(16, 16881));
  EXPECT_NE(level_problem(16881, 16, {1, 1}).find("16880 px"), std::string::npos);
}

}  // namespace
}  // namespace piblocks::h264
