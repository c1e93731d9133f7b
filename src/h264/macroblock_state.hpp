// What a macroblock leaves behind for those after it in the same picture.
// In: how it was coded. Out: nC and the predicted modes of its neighbours' blocks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

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
    return static_cast<std::size_t>((plane == 0 ? 0 : 12 + 4 * plane) + y * row_length() + x);
  }
};

/// At first that of a macroblock that is skipped, or not coded yet.
struct MacroblockState {
  static constexpr std::uint8_t kDc = 2;

  /// TotalCoeff of every block, by BlockPlace::number().
  std::array<std::uint8_t, 24> total_coeff{};
  /// Intra4x4PredMode of every luma block; DC in macroblocks of other types (8.3.1.1).
  std::array<std::uint8_t, 16> pred_modes = {kDc, kDc, kDc, kDc, kDc, kDc, kDc, kDc,
                                             kDc, kDc, kDc, kDc, kDc, kDc, kDc, kDc};
};

/// mbAddrB and mbAddrA (6.4.9); null at the edges of the picture.
struct Neighbours {
  const MacroblockState* above;
  const MacroblockState* left;

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

}  // namespace piblocks::h264
