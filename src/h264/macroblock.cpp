#include "h264/macroblock.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "h264/cavlc.hpp"

namespace piblocks::h264 {
namespace {

/// A macroblock may have 3200 bits (A.3.1), and as plain samples it has up to 3088.
constexpr std::size_t kMaxBits = 3080;

// mb_type in I slices (table 7-11); in P slices those of P macroblocks come first (table 7-13).
constexpr unsigned kINxN = 0;
constexpr unsigned kI16x16 = 1;  // plus the mode, without coefficients
constexpr unsigned kIPcm = 25;
constexpr unsigned kPL016x16 = 0;
constexpr unsigned kIntraInP = 5;

/// Table 9-4, for 4:2:0: entry k is the coded_block_pattern with codeNum k.
using Patterns = std::array<std::uint8_t, 48>;
constexpr Patterns kIntraPatterns = {
    47, 31, 15, 0,  23, 27, 29, 30, 7, 11, 13, 14, 39, 43, 45, 46, 16, 3,  5,  10, 12, 19, 21, 26,
    28, 35, 37, 42, 44, 1,  2,  4,  8, 17, 18, 20, 24, 6,  9,  22, 25, 32, 33, 34, 36, 40, 38, 41};
constexpr Patterns kInterPatterns = {
    0,  16, 1,  2,  4,  8,  32, 3,  5,  10, 12, 15, 47, 7,  11, 13, 14, 6,  9,  31, 35, 37, 42, 44,
    33, 34, 36, 40, 39, 43, 45, 46, 17, 18, 20, 24, 19, 21, 26, 28, 23, 27, 29, 30, 22, 25, 38, 41};

constexpr Patterns codes_of(const Patterns& patterns) {
  Patterns codes{};
  for (std::uint8_t code = 0; code < 48; ++code) codes[patterns[code]] = code;
  return codes;
}
constexpr Patterns kIntraCodes = codes_of(kIntraPatterns);
constexpr Patterns kInterCodes = codes_of(kInterPatterns);

/// 0.85 * 2^((QP - 12) / 3), the price that x264 and the JM encoder set.
std::int64_t price_of_a_bit(int qp) {
  constexpr std::array<std::int64_t, 3> kTimes1024 = {54, 69, 86};  // for QP 0, 1 and 2
  return kTimes1024[qp % 3] << qp / 3;
}

/// As much as the quantiser leaves of a flat difference, and at least 1.
int largest_left(int qp) { return 1 + (1 << qp / 6) / 4; }

void write_type(SliceKind slice, unsigned intra_type, BitWriter& bits) {
  bits.put_unsigned(intra_type + (slice == SliceKind::p ? kIntraInP : 0));
}

// With the bits of mb_type in an I slice, and of intra_chroma_pred_mode.
constexpr ModeCosts kLumaModes = {
    {{Prediction::vertical, 3}, {Prediction::horizontal, 3}, {Prediction::dc, 5}}};
constexpr ModeCosts kChromaModes = {
    {{Prediction::dc, 1}, {Prediction::horizontal, 3}, {Prediction::vertical, 3}}};

/// prev_intra4x4_pred_mode_flag and rem_intra4x4_pred_mode, 7.3.5.1.
void write_mode(int mode, int predicted, BitWriter& bits) {
  bits.put_flag(mode == predicted);
  if (mode != predicted) bits.put(static_cast<std::uint32_t>(mode - (mode > predicted ? 1 : 0)), 3);
}

constexpr int kOtherModeBits = 4;
int mode_bits(int mode, int predicted) { return mode == predicted ? 1 : kOtherModeBits; }

Beside beside_square(const Borders& borders, const Samples& samples, BlockPlace place) {
  const std::uint8_t* const at = samples.plane(0) + 4 * place.y * kLumaSide + 4 * place.x;
  const Border& border = borders.planes[0];
  Beside beside{borders.has_above ? border.above.data() + 4 * place.x : nullptr,
                borders.has_left ? border.left.data() + 4 * place.y : nullptr, 1};
  if (place.y > 0) beside.above = at - kLumaSide;
  if (place.x > 0) {
    beside.left = at - 1;
    beside.left_step = kLumaSide;
  }
  return beside;
}

int error_of(const Samples& a, const Samples& b) { return luma_error(a, b) + chroma_error(a, b); }

/// mb_qp_delta of 0, and the residual; nothing if there is none.
bool write_rest(const Residual& residual, int cbp, const Neighbours& beside,
                CodedMacroblock& macroblock) {
  if (cbp == 0) return true;
  macroblock.bits.put_signed(0);
  return write_residual(residual, cbp, macroblock.state, beside, macroblock.bits);
}

}  // namespace

MacroblockCoder::MacroblockCoder(int qp, int chroma_qp_offset)
    : lambda_(price_of_a_bit(qp)),
      largest_left_(largest_left(qp)),
      intra_(qp, chroma_qp(qp, chroma_qp_offset), Rounding::intra),
      inter_(qp, chroma_qp(qp, chroma_qp_offset), Rounding::inter) {}

const CodedMacroblock& MacroblockCoder::code(const MacroblockInput& input) {
  // Bits that make it worth while to look at a way: half of what those with coefficients take in
  // the article's scene. At 12 and 24 instead of 110 and 120 luma is as near, chroma by 2 dB nearer
  // (71 and 73 dB), and the time half as long again.
  constexpr int kLeastI16x16_bits = 6;
  constexpr int kLeastP16x16_bits = 110;
  constexpr int kLeastINxN_bits = 120;
  best_cost_ = std::numeric_limits<std::int64_t>::max();
  if (input.slice == SliceKind::p) try_skip(input);
  if (is_beyond(kLeastI16x16_bits)) return *best_;
  predict_i_16x16(input);
  try_i_16x16(input);
  if (input.slice == SliceKind::p && !is_beyond(kLeastP16x16_bits)) try_p_l0_16x16(input);
  if (!is_beyond(kLeastINxN_bits)) try_i_nxn(input);
  if (best_cost_ == std::numeric_limits<std::int64_t>::max()) take_i_pcm(input);
  return *best_;
}

void MacroblockCoder::judge(MacroblockKind kind, int squared_error) {
  const std::size_t bits = trial_->bits.bit_count();
  if (bits > kMaxBits) return;
  const std::int64_t cost = error_cost(squared_error) + lambda_ * static_cast<std::int64_t>(bits);
  if (cost >= best_cost_) return;
  trial_->kind = kind;
  best_cost_ = cost;
  std::swap(best_, trial_);
}

void MacroblockCoder::try_skip(const MacroblockInput& input) {
  if (largest_difference(input.source, input.before) > largest_left_) return;
  trial_->samples = input.before;
  trial_->state = {};
  trial_->bits.clear();
  judge(MacroblockKind::p_skip, error_of(input.source, trial_->samples));
}

template <typename Predict>
MacroblockCoder::Candidate MacroblockCoder::predict_best(const ModeCosts& modes,
                                                         const Borders& borders, Predict predict) {
  Candidate best{Prediction::dc, std::numeric_limits<int>::max()};
  Prediction last{};
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (const auto& [prediction, bits] : modes) {
    if (!is_possible(prediction, borders.has_above, borders.has_left)) continue;
    last = prediction;
    const int error = predict(prediction);
    const std::int64_t cost = error_cost(error) + lambda_ * bits;
    if (cost >= least) continue;
    least = cost;
    best = {prediction, error};
    if (error == 0) break;  // those that follow have no fewer bits
  }
  if (last != best.prediction) predict(best.prediction);
  return best;
}

void MacroblockCoder::predict_i_16x16(const MacroblockInput& input) {
  const Candidate luma = predict_best(kLumaModes, input.borders, [&](Prediction prediction) {
    predict_luma(prediction, input.borders, predicted_);
    return luma_error(input.source, predicted_);
  });
  const Candidate chroma = predict_best(kChromaModes, input.borders, [&](Prediction prediction) {
    predict_chroma(prediction, input.borders, predicted_);
    return chroma_error(input.source, predicted_);
  });
  luma_prediction_ = luma.prediction;
  chroma_prediction_ = chroma.prediction;
  predicted_error_ = luma.error + chroma.error;
}

void MacroblockCoder::try_i_16x16(const MacroblockInput& input) {
  if (largest_difference(input.source, predicted_) > largest_left_) return;
  trial_->samples = predicted_;
  trial_->state = {};
  trial_->bits.clear();
  write_type(input.slice, kI16x16 + static_cast<unsigned>(luma_prediction_), trial_->bits);
  trial_->bits.put_unsigned(chroma_number(chroma_prediction_));
  trial_->bits.put_signed(0);  // mb_qp_delta
  // Intra16x16DCLevel is never left out.
  const int nc = nc_of(trial_->state, input.beside, kBlockGrids[0], 0, 0);
  write_levels(Levels{}, 0, nc, trial_->bits);
  judge(MacroblockKind::i_16x16, predicted_error_);
}

void MacroblockCoder::try_p_l0_16x16(const MacroblockInput& input) {
  trial_->samples = input.before;
  for (int block = 0; block < 16; ++block) {
    code_luma_block(inter_.luma, luma_place(block), input.source, trial_->samples, residual_);
  }
  code_chroma(inter_.chroma, input.source, trial_->samples, residual_);
  trial_->state = {};
  trial_->state.totals = residual_.totals;
  const int cbp = cbp_of(residual_);
  if (cbp == 0) return;  // nothing left of the difference
  trial_->bits.clear();
  trial_->bits.put_unsigned(kPL016x16);
  trial_->bits.put_signed(0);  // mvd_l0: no motion here, and none anywhere to predict other
  trial_->bits.put_signed(0);
  trial_->bits.put_unsigned(kInterCodes[cbp]);
  if (write_rest(residual_, cbp, input.beside, *trial_)) {
    judge(MacroblockKind::p_l0_16x16, error_of(input.source, trial_->samples));
  }
}

void MacroblockCoder::code_4x4_block(const MacroblockInput& input, BlockPlace place) {
  const Beside beside = beside_square(input.borders, trial_->samples, place);
  const int guess = predicted_mode(trial_->state, input.beside, place.x, place.y);
  const int offset = 4 * place.y * kLumaSide + 4 * place.x;
  const Square source = load_square(input.source.plane(0) + offset, kLumaSide);
  Square best{};
  int mode = 0;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (const int number : {guess, 0, 1, 2}) {
    const auto prediction = static_cast<Prediction>(number);
    if (!is_possible(prediction, beside.above != nullptr, beside.left != nullptr)) continue;
    const Square square = predict_square(prediction, beside);
    const std::int64_t cost =
        error_cost(squared_error(source, square)) + lambda_ * mode_bits(number, guess);
    if (cost >= least) continue;
    least = cost;
    best = square;
    mode = number;
    if (cost <= lambda_ * kOtherModeBits) break;
  }
  store_square(best, trial_->samples.plane(0) + offset, kLumaSide);
  trial_->state.modes[4 * place.y + place.x] = static_cast<std::uint8_t>(mode);
  write_mode(mode, guess, trial_->bits);
}

void MacroblockCoder::try_i_nxn(const MacroblockInput& input) {
  trial_->samples = predicted_;  // of which the chroma stays
  trial_->state = {};
  trial_->bits.clear();
  write_type(input.slice, kINxN, trial_->bits);
  for (int block = 0; block < 16; ++block) {
    code_4x4_block(input, luma_place(block));
    code_luma_block(intra_.luma, luma_place(block), input.source, trial_->samples, residual_);
  }
  trial_->bits.put_unsigned(chroma_number(chroma_prediction_));
  code_chroma(intra_.chroma, input.source, trial_->samples, residual_);
  trial_->state.totals = residual_.totals;
  const int cbp = cbp_of(residual_);
  trial_->bits.put_unsigned(kIntraCodes[cbp]);
  if (write_rest(residual_, cbp, input.beside, *trial_)) {
    judge(MacroblockKind::i_nxn, error_of(input.source, trial_->samples));
  }
}

void MacroblockCoder::take_i_pcm(const MacroblockInput& input) {
  constexpr std::uint8_t kAll = 16;  // TotalCoeff of I_PCM, 9.2.1
  best_->kind = MacroblockKind::i_pcm;
  best_->samples = input.source;
  best_->state = {};
  best_->state.totals.fill(kAll);
  best_->bits.clear();
}

void write_i_pcm(SliceKind slice, const Samples& samples, BitWriter& bits) {
  write_type(slice, kIPcm, bits);
  bits.align();
  for (const std::uint8_t value : samples.values) bits.put(value, 8);
}

}  // namespace piblocks::h264
