#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>

#include "media/libav/video_encoder.hpp"

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(AlphaPacket, GivesBackWhatWasPutIn) {
  for (const Bytes& picture : {Bytes{}, Bytes{1}, Bytes(300, 7)}) {
    for (const Bytes& alpha : {Bytes{}, Bytes{9}, Bytes(70000, 3)}) {
      const Bytes bytes = with_alpha({picture, alpha});
      const PictureAndAlpha both = without_alpha(bytes);
      EXPECT_TRUE(std::ranges::equal(both.picture, picture));
      EXPECT_TRUE(std::ranges::equal(both.alpha, alpha));
    }
  }
}

TEST(AlphaPacket, IsNotReadBeyondItsEnd) {
  EXPECT_THROW(without_alpha(Bytes{}), MediaError);
  EXPECT_THROW(without_alpha(Bytes{0, 0, 0}), MediaError);
  EXPECT_THROW(without_alpha(Bytes{5, 2, 0, 0, 0}), MediaError);
  EXPECT_THROW(without_alpha(Bytes{255, 255, 255, 255}), MediaError);
}

}  // namespace
}  // namespace piblocks
