#include "h264/macroblock_state.hpp"

#include <algorithm>

namespace piblocks::h264 {
namespace {

constexpr int kNone = -1;

/// What the block left of (x, y) has, and the one above it, wherever they are.
template <typename Values>
int left_of(const MacroblockState& own, const Neighbours& beside, Values values,
            const BlockGrid& grid, int x, int y) {
  const int row = grid.start + y * grid.side;
  if (x > 0) return (own.*values)[row + x - 1];
  return beside.left == nullptr ? kNone : (beside.left->*values)[row + grid.side - 1];
}

template <typename Values>
int above(const MacroblockState& own, const Neighbours& beside, Values values,
          const BlockGrid& grid, int x, int y) {
  if (y > 0) return (own.*values)[grid.start + (y - 1) * grid.side + x];
  return beside.above == nullptr
             ? kNone
             : (beside.above->*values)[grid.start + (grid.side - 1) * grid.side + x];
}

}  // namespace

int nc_of(const MacroblockState& own, const Neighbours& beside, const BlockGrid& grid, int x,
          int y) {
  const int a = left_of(own, beside, &MacroblockState::totals, grid, x, y);
  const int b = above(own, beside, &MacroblockState::totals, grid, x, y);
  if (a == kNone || b == kNone) return std::max({a, b, 0});
  return (a + b + 1) / 2;
}

int predicted_mode(const MacroblockState& own, const Neighbours& beside, int x, int y) {
  const int a = left_of(own, beside, &MacroblockState::modes, kBlockGrids[0], x, y);
  const int b = above(own, beside, &MacroblockState::modes, kBlockGrids[0], x, y);
  if (a == kNone || b == kNone) return MacroblockState::kDc;
  return std::min(a, b);
}

}  // namespace piblocks::h264
