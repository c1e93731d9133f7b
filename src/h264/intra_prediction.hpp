// Samples predicted from those beside them (ITU-T H.264, 8.3).
// In: the row above and the column left of a block. Out: the block.
#pragma once

#include <cstdint>

#include "h264/picture.hpp"

namespace piblocks::h264 {

/// The modes that this encoder uses, with their numbers for luma: Intra4x4PredMode (table 8-2) and
/// Intra16x16PredMode (table 8-4).
enum class PredMode : std::uint8_t { vertical = 0, horizontal = 1, dc = 2 };

/// Their intra_chroma_pred_mode, table 8-5.
constexpr unsigned chroma_number(PredMode mode) {
  return mode == PredMode::dc ? 0 : mode == PredMode::horizontal ? 1 : 2;
}

constexpr bool is_possible(PredMode mode, bool has_above, bool has_left) {
  return mode == PredMode::dc || (mode == PredMode::vertical ? has_above : has_left);
}

/// The samples beside a block. Null where the picture ends.
struct AdjacentSamples {
  const std::uint8_t* above = nullptr;  ///< a row
  const std::uint8_t* left = nullptr;   ///< a column of samples `left_step` apart
  int left_step = 1;
};

/// Intra_4x4 prediction of luma, 8.3.1.2.
Block4x4 predict_4x4(PredMode mode, const AdjacentSamples& adjacent);
/// Intra_16x16 prediction of luma, 8.3.3.
void predict_luma(PredMode mode, const Borders& borders, Samples& samples);
/// Intra prediction of both chroma planes, 8.3.4.
void predict_chroma(PredMode mode, const Borders& borders, Samples& samples);

}  // namespace piblocks::h264
