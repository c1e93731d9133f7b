// Blocks of 4x4 samples, small enough to be handled at once.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace piblocks::h264 {

/// Row by row.
using Block4x4 = std::array<std::uint8_t, 16>;

/// @param stride  from row to row where the samples lie.
inline Block4x4 load_block(const std::uint8_t* from, int stride) {
  Block4x4 block;
  for (int y = 0; y < 4; ++y) std::memcpy(block.data() + 4 * y, from + y * stride, 4);
  return block;
}

inline void store_block(const Block4x4& block, std::uint8_t* to, int stride) {
  for (int y = 0; y < 4; ++y) std::memcpy(to + y * stride, block.data() + 4 * y, 4);
}

inline int sum_of_differences(const Block4x4& a, const Block4x4& b) {
  int sum = 0;
  for (std::size_t i = 0; i < 16; ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

/// Of `count` samples. Differences of bytes and 16 bits in the product: what processors square and
/// add up at once.
inline int squared_error(const std::uint8_t* a, const std::uint8_t* b, int count) {
  int sum = 0;
  for (int i = 0; i < count; ++i) {
    const auto difference = static_cast<std::int16_t>(a[i] - b[i]);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace piblocks::h264
