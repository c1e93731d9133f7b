// Codes of numbers, against the examples of ITU-T H.264, tables 9-1 to 9-3.
#include <gtest/gtest.h>

#include <string>

#include "h264/bit_stream.hpp"
#include "h264/bit_text.hpp"

namespace piblocks::h264 {
namespace {

std::string unsigned_code(std::uint32_t value) {
  BitWriter bits;
  bits.put_unsigned(value);
  return text_of(bits);
}

std::string signed_code(std::int32_t value) {
  BitWriter bits;
  bits.put_signed(value);
  return text_of(bits);
}

TEST(BitWriter, WritesExpGolombCodes) {
  EXPECT_EQ(unsigned_code(0), "1");
  EXPECT_EQ(unsigned_code(1), "010");
  EXPECT_EQ(unsigned_code(2), "011");
  EXPECT_EQ(unsigned_code(8), "0001001");
  EXPECT_EQ(unsigned_code(65535), std::string(16, '0') + '1' + std::string(16, '0'));
  EXPECT_EQ(signed_code(0), "1");
  EXPECT_EQ(signed_code(1), "010");
  EXPECT_EQ(signed_code(-1), "011");
  EXPECT_EQ(signed_code(-3), "00111");
}

TEST(BitWriter, EndsAndAlignsAndAppends) {
  BitWriter first;
  first.put(5, 3);
  first.put(0xffffffff, 32);
  BitWriter second;
  second.put(2, 2);
  second.append(first);
  EXPECT_EQ(text_of(second), "10101" + std::string(32, '1'));
  EXPECT_EQ(second.bit_count(), 37u);
  second.put_trailing_bits();
  EXPECT_EQ(text_of(second), "10101" + std::string(32, '1') + "100");
  EXPECT_EQ(second.bytes().size(), 5u);
  second.clear();
  EXPECT_EQ(second.bit_count(), 0u);
}

}  // namespace
}  // namespace piblocks::h264
