// What has changed in a picture.
#include <gtest/gtest.h>

#include "media/output/animated_output.hpp"
#include "support/article_frames.hpp"

namespace piblocks {
namespace {
using testing_support::Pixels;
using testing_support::random_frame;

class ChangedPictureTest : public testing::Test {
 protected:
  ChangedPictureTest() {
    picture_.take(pixels_.view(), {&kWhole, 1});
    EXPECT_EQ(picture_.changed(), kWhole);
    picture_.settle();
  }
  PixelRect changed_in(const PixelRect& rect) {
    picture_.take(pixels_.view(), {&rect, 1});
    return picture_.changed();
  }

  static constexpr PixelRect kWhole{0, 0, 40, 30};
  static constexpr PixelRect kNothing{0, 0, 1, 1};
  Pixels pixels_ = random_frame(40, 30, 1);
  ChangedPicture picture_{40, 30};
};

TEST_F(ChangedPictureTest, KnowsTheLeastRectangleAndEachPixelOfIt) {
  pixels_.at(7, 5) ^= 0x010000;
  pixels_.at(20, 11) ^= 0x000001;
  EXPECT_EQ(changed_in(kWhole), (PixelRect{7, 5, 14, 7}));
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      EXPECT_EQ(picture_.row(y)[x], pixels_.at(x, y));
      EXPECT_EQ(picture_.marks(y)[x], (x == 7 && y == 5) || (x == 20 && y == 11)) << x << ' ' << y;
    }
  }
  picture_.settle();
  EXPECT_EQ(changed_in(kWhole), kNothing);
}

TEST_F(ChangedPictureTest, EverythingMayCountAsChanged) {
  picture_.mark_all();
  EXPECT_EQ(picture_.changed(), kWhole);
  EXPECT_EQ(picture_.marks(29)[39], 1);
}

TEST_F(ChangedPictureTest, LooksAtTheGivenRectanglesAlone) {
  pixels_.at(3, 3) ^= 1;
  pixels_.at(30, 20) ^= 1;
  EXPECT_EQ(changed_in({0, 0, 10, 10}), (PixelRect{3, 3, 1, 1}));
}

TEST_F(ChangedPictureTest, WhatIsInPlaceOfAnOpaquePixelsAlphaDoesNotMatter) {
  pixels_.at(2, 1) &= 0x00ffffff;
  EXPECT_EQ(changed_in(kWhole), kNothing);
}

}  // namespace
}  // namespace piblocks
