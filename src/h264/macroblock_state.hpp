// What a macroblock leaves behind for those after it in the same picture.
// In: how it was coded. Out: contexts and predictions of its neighbours' codes.
#pragma once

#include <array>
#include <cstdint>

namespace piblocks::h264 {

/// The squares of 4x4 samples of one plane in a macroblock, as numbered below.
struct BlockGrid {
  int start;
  int side;
};
/// Y, Cb, Cr.
inline constexpr std::array<BlockGrid, 3> kBlockGrids = {{{0, 4}, {16, 2}, {20, 2}}};

/// Of one that is skipped, or not coded yet.
struct MacroblockState {
  static constexpr std::uint8_t kDc = 2;

  /// TotalCoeff of every block, plane by plane, row by row.
  std::array<std::uint8_t, 24> totals{};
  /// Intra4x4PredMode of every luma block; DC stands for any other kind of macroblock (8.3.1.1).
  std::array<std::uint8_t, 16> modes = {kDc, kDc, kDc, kDc, kDc, kDc, kDc, kDc,
                                        kDc, kDc, kDc, kDc, kDc, kDc, kDc, kDc};
};

/// Null pointers at the edges of the picture.
struct Neighbours {
  const MacroblockState* above;
  const MacroblockState* left;
};

/// nC of 9.2.1 for the block at column `x` and row `y` of a grid.
int nc_of(const MacroblockState& own, const Neighbours& beside, const BlockGrid& grid, int x,
          int y);
/// predIntra4x4PredMode of 8.3.1.1.
int predicted_mode(const MacroblockState& own, const Neighbours& beside, int x, int y);

}  // namespace piblocks::h264
