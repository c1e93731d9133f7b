#include "media/pixels/changed_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/article_frames.hpp"

namespace piblocks {
namespace {
using testing_support::Pixels;
using testing_support::random_frame;

TEST(ChangedPicture, KnowsTheLeastRectangleAndEachPixelOfIt) {
  Pixels pixels = random_frame(40, 30, 1);
  ChangedPicture picture(40, 30);
  const PixelRect whole{0, 0, 40, 30};
  picture.take(pixels.view(), {&whole, 1});
  EXPECT_EQ(picture.changed(), whole);
  picture.settle();
  pixels.at(7, 5) ^= 0x010000;
  pixels.at(20, 11) ^= 0x000001;
  picture.take(pixels.view(), {&whole, 1});
  EXPECT_EQ(picture.changed(), (PixelRect{7, 5, 14, 7}));
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      EXPECT_EQ(picture.row(y)[x], pixels.at(x, y));
      EXPECT_EQ(picture.marks(y)[x], (x == 7 && y == 5) || (x == 20 && y == 11)) << x << ' ' << y;
    }
  }
  picture.settle();
  picture.take(pixels.view(), {&whole, 1});
  EXPECT_EQ(picture.changed(), (PixelRect{0, 0, 1, 1})) << "nothing has changed";
}

TEST(ChangedPicture, LooksAtTheGivenRectanglesAlone) {
  Pixels pixels = random_frame(40, 30, 2);
  ChangedPicture picture(40, 30);
  const PixelRect whole = picture.whole();
  picture.take(pixels.view(), {&whole, 1});
  picture.settle();
  pixels.at(3, 3) ^= 1;
  pixels.at(30, 20) ^= 1;
  const PixelRect part{0, 0, 10, 10};
  picture.take(pixels.view(), {&part, 1});
  EXPECT_EQ(picture.changed(), (PixelRect{3, 3, 1, 1}));
}

TEST(ChangedPicture, WhatIsInPlaceOfAnOpaquePixelsAlphaDoesNotMatter) {
  Pixels pixels = random_frame(4, 3, 3);
  ChangedPicture picture(4, 3);
  const PixelRect whole = picture.whole();
  picture.take(pixels.view(), {&whole, 1});
  picture.settle();
  pixels.at(2, 1) &= 0x00ffffff;
  picture.take(pixels.view(), {&whole, 1});
  EXPECT_EQ(picture.changed(), (PixelRect{0, 0, 1, 1}));
}

}  // namespace
}  // namespace piblocks
