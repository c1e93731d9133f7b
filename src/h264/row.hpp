// Four numbers that processors add and multiply at once, by the vector extension of GCC and clang.
// In: rows. Out: their product.
#pragma once

#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace piblocks::h264 {

using Row = std::int32_t __attribute__((vector_size(16)));

/// The product of 16-bit numbers: SSE2 has no instruction for 32 bits.
inline Row multiplied(Row a, Row b) {
#ifdef __SSE2__
  return reinterpret_cast<Row>(
      _mm_madd_epi16(reinterpret_cast<__m128i>(a), reinterpret_cast<__m128i>(b)));
#else
  return a * b;
#endif
}

}  // namespace piblocks::h264
