// Differences as transform coefficient levels, and back (ITU-T H.264, 8.5).
// In: blocks of 4x4 samples and their predictions. Out: levels in scan order, and the samples that
// every decoder makes of them.
#pragma once

#include <array>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "h264/picture.hpp"

namespace piblocks::h264 {

/// Four numbers that processors add and multiply at once, by the vector extension of GCC and clang.
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

/// Coefficients of a 4x4 block, column by column: that saves a transposition.
using Coefficients = std::array<Row, 4>;
/// Transform coefficient levels in the order of the zig-zag scan (table 8-13, frames).
using Levels = std::array<std::int16_t, 16>;

/// QP'C for QP'Y, without an offset (8.5.8, table 8-15).
int chroma_qp(int luma_qp);

/// A quantiser rounds up late, since small levels cost more bits than they repair error.
enum class Rounding { intra, inter };

class Quantiser {
 public:
  /// @param qp  from 0 to 51; see kMaxQp in picture_encoder.hpp.
  Quantiser(int qp, Rounding rounding);

  /// The largest sum of absolute differences that always leaves no level: a coefficient is at most
  /// 1, 2 or 4 times the sum.
  int negligible_sum() const noexcept { return negligible_sum_; }
  /// Turns coefficients into levels, and then into what decoders make of these (8.5.12.1).
  /// @return TotalCoeff; if it is 0, the coefficients are undefined.
  int quantise(Coefficients& coefficients, Levels& levels) const;
  /// The same for the DC coefficients of a chroma plane, which have a transform of their own
  /// (8.5.11).
  int quantise_chroma_dc(std::array<std::int32_t, 4>& dc,
                         std::array<std::int16_t, 4>& levels) const;

 private:
  Coefficients factors_;
  Coefficients scales_;
  int shift_;
  std::int32_t rounding_;
  int negligible_sum_;
};

/// The transform of source - predicted.
Coefficients transform_difference(const Block4x4& source, const Block4x4& predicted);
/// The prediction plus the inverse transform, 8.5.12.2 and 8.5.14.
Block4x4 add_inverse(Coefficients coefficients, const Block4x4& predicted);

}  // namespace piblocks::h264
