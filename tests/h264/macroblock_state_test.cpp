// nC and predicted modes, against those found in a whole picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "h264/residual.hpp"
#include "support/property.hpp"

namespace piblocks::h264 {
namespace {

constexpr int kColumns = 3;
constexpr int kRows = 3;

/// Pictures of 3x3 macroblocks.
class MacroblockStateTest : public testing::Test {
 protected:
  MacroblockStateTest() : states_(kColumns * kRows) {
    for (MacroblockState& state : states_) {
      for (auto& total : state.total_coeff)
        total = static_cast<std::uint8_t>(random_.integer(0, 16));
      for (auto& mode : state.pred_modes) mode = static_cast<std::uint8_t>(random_.integer(0, 8));
    }
  }

  const MacroblockState& at(int x_mb, int y_mb) const {
    return states_[static_cast<std::size_t>(y_mb * kColumns + x_mb)];
  }
  Neighbours beside(int x_mb, int y_mb) const {
    return {y_mb > 0 ? &at(x_mb, y_mb - 1) : nullptr, x_mb > 0 ? &at(x_mb - 1, y_mb) : nullptr};
  }
  /// TotalCoeff of the block at a place of the whole picture, or -1 outside.
  int total(int plane, int x, int y) const {
    if (x < 0 || y < 0) return -1;
    const int side = plane == 0 ? 4 : 2;
    const BlockPlace place = {x % side, y % side, plane};
    return at(x / side, y / side).total_coeff[place.number()];
  }
  int mode(int x, int y) const {
    if (x < 0 || y < 0) return -1;
    return at(x / 4, y / 4).pred_modes[static_cast<std::size_t>(y % 4 * 4 + x % 4)];
  }

  Random random_{921};
  std::vector<MacroblockState> states_;
};

TEST_F(MacroblockStateTest, NcIsTheMeanOfNeighbours) {
  for (int plane = 0; plane < 3; ++plane) {
    const int side = plane == 0 ? 4 : 2;
    for (int y = 0; y < kRows * side; ++y) {
      for (int x = 0; x < kColumns * side; ++x) {
        const int a = total(plane, x - 1, y);
        const int b = total(plane, x, y - 1);
        // 9.2.1
        const int expected = a >= 0 && b >= 0 ? (a + b + 1) >> 1 : a >= 0 ? a : b >= 0 ? b : 0;
        const int x_mb = x / side;
        const int y_mb = y / side;
        EXPECT_EQ(nc_of(at(x_mb, y_mb), beside(x_mb, y_mb), {x % side, y % side, plane}), expected)
            << "plane " << plane << ", block " << x << ", " << y;
      }
    }
  }
}

TEST_F(MacroblockStateTest, TheLesserOfTheNeighboursModesIsPredicted) {
  for (int y = 0; y < 4 * kRows; ++y) {
    for (int x = 0; x < 4 * kColumns; ++x) {
      // 8.3.1.1: DC if one of the two does not exist.
      const int expected = x > 0 && y > 0 ? std::min(mode(x - 1, y), mode(x, y - 1)) : 2;
      EXPECT_EQ(predicted_mode(at(x / 4, y / 4), beside(x / 4, y / 4), {x % 4, y % 4}), expected)
          << "block " << x << ", " << y;
    }
  }
}

TEST_F(MacroblockStateTest, BeginsAsThatOfASkippedMacroblock) {
  const MacroblockState state;
  EXPECT_TRUE(std::ranges::all_of(state.total_coeff, [](int total) { return total == 0; }));
  EXPECT_TRUE(std::ranges::all_of(state.pred_modes, [](int mode) { return mode == 2; }));
}

}  // namespace
}  // namespace piblocks::h264
