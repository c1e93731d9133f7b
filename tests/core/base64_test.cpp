#include "core/text.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace piblocks {
namespace {

std::string of(std::string_view text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

// RFC 4648, section 10.
TEST(Base64, HasTheTextsOfTheStandard) {
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(Base64, HasAllDigits) {
  const std::vector<std::uint8_t> bytes{0xfb, 0xef, 0xbe, 0xff, 0xff, 0xff};
  EXPECT_EQ(base64(bytes), "++++////");
}

TEST(Base64, OfPiecesIsThatOfTheWhole) {
  EXPECT_EQ(of("pieces") + of("of th"), of("piecesof th"));
  EXPECT_NE(of("piec") + of("es"), of("pieces"));
}

}  // namespace
}  // namespace piblocks
