// The differences that prediction leaves in a macroblock, and what it leaves to those after it.
// In: what the macroblock should be, and what was predicted. Out: transform coefficient levels, the
// samples that decoders make of them, and their bits.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "h264/bit_stream.hpp"
#include "h264/picture.hpp"
#include "h264/transform.hpp"

namespace piblocks::h264 {

/// A block of 4x4 samples in a macroblock: its column and row in a plane (0 Y, 1 Cb, 2 Cr).
struct BlockPlace {
  int x;
  int y;
  int plane = 0;

  /// Blocks beside each other.
  constexpr int row_length() const { return plane == 0 ? 4 : 2; }
  /// Among all blocks of the macroblock, plane by plane, row by row.
  constexpr std::size_t number() const {
    const int first = plane == 0 ? 0 : 12 + 4 * plane;
    const int number = first + y * row_length() + x;
    return static_cast<std::size_t>(number);
  }
};

/// mvL0, in whole luma samples.
struct MotionVector {
  int x = 0;
  int y = 0;
  bool operator==(const MotionVector&) const = default;
};

/// By default the state of a macroblock that is skipped without motion, or not coded yet.
struct MacroblockState {
  static constexpr std::uint8_t kDc = 2;

  /// TotalCoeff of every block, by BlockPlace::number().
  std::array<std::uint8_t, 24> total_coeff{};
  /// Intra4x4PredMode of every luma block; DC in macroblocks of other types (8.3.1.1).
  std::array<std::uint8_t, 16> pred_modes = {kDc, kDc, kDc, kDc, kDc, kDc, kDc, kDc,
                                             kDc, kDc, kDc, kDc, kDc, kDc, kDc, kDc};
  MotionVector vector{};  ///< of inter macroblocks
  bool is_intra = false;

  bool operator==(const MacroblockState&) const = default;
};

/// mbAddrB, mbAddrA, and mbAddrC or, if that is not available, mbAddrD (6.4.9, 8.4.1.3.2); null
/// outside of the picture.
struct Neighbours {
  const MacroblockState* above;
  const MacroblockState* left;
  const MacroblockState* corner = nullptr;

  /// The values of the blocks left of a block and above it (6.4.11.4); -1 outside the picture.
  template <typename Values>
  std::array<int, 2> values(Values MacroblockState::*values, const MacroblockState& own,
                            BlockPlace place) const {
    const auto [x, y, plane] = place;
    const int last = place.row_length() - 1;
    const auto value = [&](const MacroblockState* state, BlockPlace block) {
      return state == nullptr ? -1 : int{(state->*values)[block.number()]};
    };
    return {x > 0 ? value(&own, {x - 1, y, plane}) : value(left, {last, y, plane}),
            y > 0 ? value(&own, {x, y - 1, plane}) : value(above, {x, last, plane})};
  }
};

/// nC of 9.2.1.
inline int nc_of(const MacroblockState& own, const Neighbours& neighbours, BlockPlace place) {
  const auto [a, b] = neighbours.values(&MacroblockState::total_coeff, own, place);
  return a < 0 || b < 0 ? std::max({a, b, 0}) : (a + b + 1) / 2;
}

/// predIntra4x4PredMode of 8.3.1.1.
inline int predicted_mode(const MacroblockState& own, const Neighbours& neighbours,
                          BlockPlace place) {
  const auto [a, b] = neighbours.values(&MacroblockState::pred_modes, own, place);
  return a < 0 || b < 0 ? MacroblockState::kDc : std::min(a, b);
}

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
  void code_chroma(const Quantiser& quantiser, const Samples& source, Samples& samples) {
    for (int plane = 1; plane < 3; ++plane) code_chroma_plane(quantiser, plane, source, samples);
  }

  /// As in MacroblockState.
  const std::array<std::uint8_t, 24>& total_coeff() const { return total_coeff_; }
  /// coded_block_pattern, 7.4.5.
  int coded_block_pattern() const;
  /// residual(), 7.3.5.3.
  /// @param pattern  coded_block_pattern()
  /// @param own        has this residual's total_coeff().
  /// @param most_bits  it may stop once `bits` has more
  /// @return false if it has stopped, or a level is too large for its code.
  bool write(int pattern, const MacroblockState& own, const Neighbours& neighbours,
             std::size_t most_bits, BitWriter& bits) const;

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
