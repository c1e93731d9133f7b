// Samples guessed from those beside them (ITU-T H.264, 8.3).
// In: the row above and the column left of a square. Out: the square.
#pragma once

#include <array>
#include <cstdint>

#include "h264/picture.hpp"
#include "h264/square.hpp"

namespace piblocks::h264 {

/// The ways that this encoder uses, with their numbers for luma (tables 8-2 and 8-4).
enum class Prediction : std::uint8_t { vertical = 0, horizontal = 1, dc = 2 };
inline constexpr std::array kPredictions = {Prediction::vertical, Prediction::horizontal,
                                            Prediction::dc};

/// intra_chroma_pred_mode, table 8-5.
constexpr unsigned chroma_number(Prediction prediction) {
  return prediction == Prediction::dc ? 0 : prediction == Prediction::horizontal ? 1 : 2;
}

constexpr bool is_possible(Prediction prediction, bool has_above, bool has_left) {
  return prediction == Prediction::dc ||
         (prediction == Prediction::vertical ? has_above : has_left);
}

/// A null pointer stands for samples that there are none of.
struct Beside {
  const std::uint8_t* above;  ///< a row
  const std::uint8_t* left;   ///< one below the other, `left_step` apart
  int left_step;
};

/// 8.3.1.2: a square of luma.
Square predict_square(Prediction prediction, const Beside& beside);
/// 8.3.3: the luma of a macroblock.
void predict_luma(Prediction prediction, const Borders& borders, Samples& samples);
/// 8.3.4: its chroma.
void predict_chroma(Prediction prediction, const Borders& borders, Samples& samples);

}  // namespace piblocks::h264
