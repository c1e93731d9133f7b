// The differences that prediction leaves in a macroblock.
// In: what the macroblock should be, and what was predicted. Out: transform coefficient levels, the
// samples that decoders make of them, and their bits.
#pragma once

#include <array>
#include <cstdint>

#include "h264/bit_writer.hpp"
#include "h264/macroblock_state.hpp"
#include "h264/picture.hpp"
#include "h264/transform.hpp"

namespace piblocks::h264 {

/// The place of luma4x4BlkIdx (6.4.3), which goes through the macroblock by quarters.
constexpr BlockPlace luma_place(int index) {
  return {(index & 1) | (index >> 1 & 2), (index >> 1 & 1) | (index >> 2 & 2)};
}

/// The levels of a macroblock with 4x4 transforms throughout. Every block is coded before anything
/// else is asked.
class Residual {
 public:
  /// Codes what a luma block of `samples`, the prediction, lacks. `samples` becomes what decoders
  /// will have.
  void code_luma(const Quantiser& quantiser, BlockPlace place, const Samples& source,
                 Samples& samples);
  /// The same for both chroma planes.
  void code_chroma(const Quantiser& quantiser, const Samples& source, Samples& samples);

  /// As in MacroblockState.
  const std::array<std::uint8_t, 24>& total_coeff() const { return total_coeff_; }
  /// coded_block_pattern, 7.4.5.
  int coded_block_pattern() const;
  /// residual(), 7.3.5.3.
  /// @param pattern  coded_block_pattern()
  /// @param own      has this residual's total_coeff().
  /// @return false if a level is too large for its code.
  bool write(int pattern, const MacroblockState& own, const Neighbours& neighbours,
             BitWriter& bits) const;

 private:
  void code_chroma_plane(const Quantiser& quantiser, int plane, const Samples& source,
                         Samples& samples);

  // Only blocks with a TotalCoeff above 0 have valid levels.
  std::array<Levels, 24> levels_;                  // chroma: AC, behind a first level of 0
  std::array<std::array<std::int16_t, 4>, 2> dc_;  // of Cb and Cr
  std::array<int, 2> dc_total_coeff_;
  std::array<std::uint8_t, 24> total_coeff_;
};

}  // namespace piblocks::h264
