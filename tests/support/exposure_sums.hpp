// What an exposure says of a block's position, for tests.
// In: an exposure and a position. Out: shares of time, and their integrals.
#pragma once

#include <algorithm>

#include "physics/exposure.hpp"

namespace piblocks {

/// The share of the time in which the block's centre is at or below `position`, summed over pieces.
inline double share_below(const PairExposure& exposure, BlockName block, double position) {
  double share = 0;
  for (const UniformPiece& piece : exposure.pieces) {
    const auto [low, high] = std::minmax(piece.of(block).from, piece.of(block).to);
    share += piece.share * (position >= high  ? 1
                            : position <= low ? 0
                                              : (position - low) / (high - low));
  }
  return position >= exposure.range(block).to ? 1 : std::min(share, 1.0);
}

/// The integral of that share up to `position`, summed over pieces.
inline double area_of_pieces(const PairExposure& exposure, BlockName block, double position) {
  double area = 0;
  for (const UniformPiece& piece : exposure.pieces) {
    area += piece.share * piece.of(block).area_below(position);
  }
  return area;
}

/// The same integral as drawing takes it.
inline double area_below(const PairExposure& exposure, BlockName block, double position) {
  return exposure.area_below ? exposure.area_below(block, position)
                             : area_of_pieces(exposure, block, position);
}

}  // namespace piblocks
