// Differences as quantised coefficients, and back (ITU-T H.264, 8.5).
// In: squares of 4x4 samples, and what was predicted for them. Out: levels in scan order, and the
// samples that every decoder makes of them.
#pragma once

#include <array>
#include <cstdint>

#include "h264/square.hpp"

namespace piblocks::h264 {

/// Four numbers that the processor adds and multiplies at once.
using Row = std::int32_t __attribute__((vector_size(16)));
/// Coefficients of 4x4 samples, column by column: that saves turning them round.
using Coefficients = std::array<Row, 4>;
/// Quantised ones in the order of the scan (table 8-13, frames).
using Levels = std::array<std::int16_t, 16>;

/// QP'c for a QPy (8.5.8, table 8-15).
int chroma_qp(int luma_qp, int offset);

/// Where a quantiser rounds to the next level: late, because small levels cost more than they mend.
enum class Rounding { intra, inter };

class Quantiser {
 public:
  /// @param qp  from 0 to 51. From 42 on, a square that differs by nearly 255 throughout may ask
  ///            more than 16 bits of decoders, which 8.5.12.2 forbids.
  Quantiser(int qp, Rounding rounding);

  /// A sum of absolute differences that leaves no level: every coefficient is at most 1, 2 or 4
  /// times the sum.
  int negligible_sum() const noexcept { return negligible_sum_; }
  /// Turns coefficients into levels, and into what decoders make of these (8.5.12.1).
  /// @return how many levels are not zero; if none, the coefficients are of no use any more.
  int quantise(Coefficients& coefficients, Levels& levels) const;
  /// The same for the DC coefficients of the four blocks of a chroma plane, through a transform of
  /// their own (8.5.11).
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
Coefficients transform_difference(const Square& source, const Square& predicted);
/// 8.5.12.2 and 8.5.14: what was predicted, and what the coefficients stand for.
Square add_inverse(Coefficients coefficients, const Square& predicted);

}  // namespace piblocks::h264
