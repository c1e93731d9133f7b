// The differences that prediction leaves in a macroblock.
// In: what the macroblock should be, and what was predicted. Out: levels, what decoders make of
// them, and their bits.
#pragma once

#include <array>
#include <cstdint>

#include "h264/bit_writer.hpp"
#include "h264/macroblock_state.hpp"
#include "h264/picture.hpp"
#include "h264/transform.hpp"

namespace piblocks::h264 {

/// Where block `number` of the luma lies, in blocks (6.4.3): by quarters of the macroblock.
struct BlockPlace {
  int x;
  int y;
};
constexpr BlockPlace luma_place(int number) {
  return {(number & 1) | (number >> 1 & 2), (number >> 1 & 1) | (number >> 2 & 2)};
}

/// Of luma and chroma.
struct Quantisers {
  Quantisers(int luma_qp, int chroma_qp, Rounding rounding)
      : luma(luma_qp, rounding), chroma(chroma_qp, rounding) {}
  Quantiser luma;
  Quantiser chroma;
};

/// The levels of a macroblock with blocks of 4x4 throughout.
struct Residual {
  std::array<Levels, 16> luma;  ///< row by row
  std::array<std::array<std::int16_t, 4>, 2> chroma_dc;
  std::array<Levels, 8> chroma_ac;  ///< Cb, then Cr, row by row; the first level of each is 0
  /// TotalCoeff of each, as in MacroblockState.
  std::array<std::uint8_t, 24> totals;
  std::array<int, 2> dc_totals;
};

/// Codes one block of 4x4: `samples` holds what was predicted, and then what decoders will have.
void code_luma_block(const Quantiser& quantiser, BlockPlace place, const Samples& source,
                     Samples& samples, Residual& residual);
/// The same for both planes of chroma.
void code_chroma(const Quantiser& quantiser, const Samples& source, Samples& samples,
                 Residual& residual);

/// coded_block_pattern, 7.4.5.
int cbp_of(const Residual& residual);
/// residual(), 7.3.5.3, for a coded_block_pattern.
/// @return false if a level is too large for its code.
bool write_residual(const Residual& residual, int cbp, const MacroblockState& own,
                    const Neighbours& beside, BitWriter& bits);

}  // namespace piblocks::h264
