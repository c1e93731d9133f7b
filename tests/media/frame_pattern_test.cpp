#include "media/output/frame_pattern.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include "support/contains.hpp"
#include "support/message_of.hpp"

namespace piblocks {
namespace {
using testing_support::contains;

TEST(FramePattern, WritesTheNumberWithTheFieldsDigits) {
  EXPECT_EQ(FramePattern("%d.png").name(7), "7.png");
  EXPECT_EQ(FramePattern("a%06d.png").name(7), "a000007.png");
  EXPECT_EQ(FramePattern("a%01d.png").name(123), "a123.png");
}

TEST(FramePattern, WritesLongNumbersInFull) {
  EXPECT_EQ(FramePattern("%02d.png").name(12345), "12345.png");
  EXPECT_EQ(FramePattern("%09d.png").name(9'000'000'000), "9000000000.png");
}

TEST(FramePattern, TakesTwoPercentSignsForOne) {
  EXPECT_EQ(FramePattern("100%%_%03d%%.png").name(1), "100%_001%.png");
  EXPECT_EQ(FramePattern("%%d%d.png").name(1), "%d1.png");
}

TEST(FramePattern, TellsTheFolderApart) {
  EXPECT_EQ(FramePattern("%d.png").folder(), "");
  EXPECT_EQ(FramePattern("/%d.png").folder(), "/");
  const FramePattern pattern("a/50%%/f%d.png");
  EXPECT_EQ(pattern.folder(), "a/50%/");
  EXPECT_EQ(pattern.name(2), "f2.png");
}

TEST(FramePattern, LeavesBracesAlone) {
  EXPECT_EQ(FramePattern("{}%d{0}.png").name(3), "{}3{0}.png");
}

class BadPattern : public testing::TestWithParam<const char*> {};

TEST_P(BadPattern, IsRefusedWithAnExample) {
  const std::string what =
      testing_support::message_of<UsageError>([] { FramePattern{GetParam()}; });
  EXPECT_NE(what, "") << GetParam() << " was taken";
  EXPECT_TRUE(contains(what, GetParam()));
  EXPECT_TRUE(contains(what, "frames/%06d.png"));
  EXPECT_FALSE(contains(what, "\n"));
}

INSTANTIATE_TEST_SUITE_P(All, BadPattern,
                         testing::Values("a.png", "%%.png", "%d%d.png", "%03d_%d.png", "%s.png",
                                         "%n.png", "%5d.png", "%0d.png", "%00d.png", "%010d.png",
                                         "%03i.png", "%ld.png", "%-3d.png", "%", "%0", "%03", "a%",
                                         "%d/a.png", "%03d/%%.png", "% d.png", "%%%.png"));

TEST(FramePattern, KnowsItsFilesByTheirNumbers) {
  const FramePattern pattern("f/a%03d.png");
  for (const std::int64_t number : {0, 1, 12, 999, 1000, 123456}) {
    EXPECT_EQ(pattern.number_of(pattern.name(number)), number);
  }
  for (const char* other :
       {"a1.png", "a0001.png", "a-01.png", "a+01.png", "a 01.png", "b001.png", "a001.jpg",
        "a001.png~", "a.png", "a", "", "a99999999999999999999.png"}) {
    EXPECT_EQ(pattern.number_of(other), std::nullopt) << other;
  }
  EXPECT_EQ(pattern.label(), FramePattern("a%d.png").label());
}

}  // namespace
}  // namespace piblocks
