// Squares of 4x4 samples, small enough to be handled at once.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace piblocks::h264 {

/// Row by row.
using Square = std::array<std::uint8_t, 16>;

/// @param stride  from row to row of where the samples lie.
inline Square load_square(const std::uint8_t* from, int stride) {
  Square square;
  for (int y = 0; y < 4; ++y) std::memcpy(square.data() + 4 * y, from + y * stride, 4);
  return square;
}

inline void store_square(const Square& square, std::uint8_t* to, int stride) {
  for (int y = 0; y < 4; ++y) std::memcpy(to + y * stride, square.data() + 4 * y, 4);
}

inline int sum_of_differences(const Square& a, const Square& b) {
  int sum = 0;
  for (std::size_t i = 0; i < 16; ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

inline int squared_error(const Square& a, const Square& b) {
  int sum = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto difference = static_cast<std::int16_t>(a[i] - b[i]);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace piblocks::h264
