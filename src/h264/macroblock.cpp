#include "h264/macroblock.hpp"

#include <array>
#include <utility>

#include "h264/cavlc.hpp"

namespace piblocks::h264 {
namespace {

/// A macroblock may have 3200 bits (A.3.1). I_PCM has up to 3088.
constexpr std::size_t kMaxBits = 3080;

// mb_type in I slices (table 7-11); in P slices those of P macroblocks come first (table 7-13).
constexpr unsigned kINxN = 0;
constexpr unsigned kI16x16 = 1;  // plus Intra16x16PredMode, without coefficients
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
std::int64_t lambda_of(int qp) {
  constexpr std::array<std::int64_t, 3> kTimes1024 = {54, 69, 86};  // for QP 0, 1 and 2
  return kTimes1024[qp % 3] << qp / 3;
}

void write_intra_type(SliceType slice_type, unsigned mb_type, BitWriter& bits) {
  bits.put_unsigned(mb_type + (slice_type == SliceType::p ? kIntraInP : 0));
}

/// A prediction mode, and how many bits it takes to write it.
struct ModeBits {
  PredMode mode;
  int bits;
};
using ModesBits = std::array<ModeBits, 3>;
// The bits of mb_type in an I slice, and of intra_chroma_pred_mode.
constexpr ModesBits kLumaModes = {
    {{PredMode::vertical, 3}, {PredMode::horizontal, 3}, {PredMode::dc, 5}}};
constexpr ModesBits kChromaModes = {
    {{PredMode::dc, 1}, {PredMode::horizontal, 3}, {PredMode::vertical, 3}}};

AdjacentSamples beside_block(const Borders& borders, const Samples& samples, BlockPlace place) {
  const std::uint8_t* const at = samples.plane(0) + 4 * place.y * kLumaSide + 4 * place.x;
  const Border& border = borders.planes[0];
  AdjacentSamples adjacent{borders.has_above ? border.above.data() + 4 * place.x : nullptr,
                           borders.has_left ? border.left.data() + 4 * place.y : nullptr};
  if (place.y > 0) adjacent.above = at - kLumaSide;
  if (place.x > 0) adjacent = {adjacent.above, at - 1, kLumaSide};
  return adjacent;
}

/// mb_type P_L0_16x16 and mvd_l0, in quarters of a sample (7.3.5.1).
void write_p_l0_16x16(MotionVector vector, const Neighbours& neighbours, BitWriter& bits) {
  const MotionVector predicted = predicted_vector(neighbours);
  bits.put_unsigned(kPL016x16);
  bits.put_signed(4 * (vector.x - predicted.x));
  bits.put_signed(4 * (vector.y - predicted.y));
}

int error_of(const Samples& a, const Samples& b) { return luma_error(a, b) + chroma_error(a, b); }

}  // namespace

MacroblockCoder::MacroblockCoder(int qp)
    : lambda_(lambda_of(qp)),
      tolerance_(1 + (1 << qp / 6) / 4),  // what the quantiser leaves of a flat difference
      intra_{{qp, Rounding::intra}, {chroma_qp(qp), Rounding::intra}},
      inter_{{qp, Rounding::inter}, {chroma_qp(qp), Rounding::inter}} {}

CodedMacroblock MacroblockCoder::code(const MacroblockInput& input) const {
  // A type is tried if so many bits of it would cost less than the best type so far: about what it
  // takes in the article's scene (README.md has the measurements).
  constexpr int kTryI16x16_bits = 6;
  constexpr int kTryPL016x16_bits = 200;
  constexpr int kTryINxN_bits = 300;
  const bool is_p = input.slice_type == SliceType::p;
  CodedMacroblock best = is_p ? p_skip(input) : CodedMacroblock(MbType::i_pcm);
  const auto compare = [&](auto&& candidate) {
    if (candidate.cost < best.cost) best = std::forward<decltype(candidate)>(candidate);
  };
  const auto may_cost_less = [&](int bits) { return cost(0, bits) < best.cost; };

  if (!may_cost_less(kTryI16x16_bits)) return best;
  const CodedMacroblock predicted = i_16x16(input);
  compare(predicted);
  if (is_p && may_cost_less(kTryPL016x16_bits)) {
    CodedMacroblock moved = p_moved(input, best.cost);
    if (moved.cost < best.cost) return moved;
    compare(p_l0_16x16(input, skip_vector(input.neighbours), input.before, best.cost));
  }
  if (may_cost_less(kTryINxN_bits)) compare(i_nxn(input, predicted, best.cost));
  if (best.cost == CodedMacroblock::kImpossible) {
    best.type = MbType::i_pcm;
    best.samples = input.source;
    best.state = {};
    best.state.is_intra = true;
    best.state.total_coeff.fill(16);  // 9.2.1
  }
  return best;
}

void MacroblockCoder::set_cost(CodedMacroblock& coded, int squared_error) const {
  const std::size_t bits = coded.bits.bit_count();
  if (bits <= kMaxBits) coded.cost = cost(squared_error, static_cast<std::int64_t>(bits));
}

void MacroblockCoder::finish(const MacroblockInput& input, const Residual& residual, int pattern,
                             std::int64_t cost_limit, CodedMacroblock& coded) const {
  const int error = error_of(input.source, coded.samples);
  const std::size_t most_bits = bits_below(cost_limit, error);
  coded.bits.put_unsigned(coded.type == MbType::i_nxn ? kIntraCodes[pattern]
                                                      : kInterCodes[pattern]);
  coded.state.total_coeff = residual.total_coeff();
  coded.has_residual = pattern != 0;
  if (coded.has_residual) {
    coded.bits.put_signed(0);  // mb_qp_delta
    if (!residual.write(pattern, coded.state, input.neighbours, most_bits, coded.bits)) return;
  }
  set_cost(coded, error);
}

CodedMacroblock MacroblockCoder::p_skip(const MacroblockInput& input) const {
  CodedMacroblock coded(MbType::p_skip);
  coded.state.vector = skip_vector(input.neighbours);
  if (largest_difference(input.source, input.before) > tolerance(coded.state.vector)) return coded;
  coded.samples = input.before;
  set_cost(coded, error_of(input.source, input.before));
  return coded;
}

CodedMacroblock MacroblockCoder::hold(const Samples& before, const Neighbours& neighbours) {
  CodedMacroblock coded(MbType::p_l0_16x16);
  coded.samples = before;
  write_p_l0_16x16({}, neighbours, coded.bits);
  coded.bits.put_unsigned(kInterCodes[0]);
  return coded;
}

CodedMacroblock MacroblockCoder::i_16x16(const MacroblockInput& input) const {
  const Borders& borders = input.borders;
  CodedMacroblock coded(MbType::i_16x16);
  int total_error = 0;
  // Predicts by the cheapest mode. @param predict  does so, and returns the squared error.
  const auto choose = [&](const ModesBits& modes, const auto& predict) {
    PredMode best{};
    PredMode last{};
    int least_error = 0;
    std::int64_t least_cost = CodedMacroblock::kImpossible;
    for (const auto& [mode, bits] : modes) {
      if (!is_possible(mode, borders.has_above, borders.has_left)) continue;
      last = mode;
      const int error = predict(mode);
      if (cost(error, bits) >= least_cost) continue;
      least_cost = cost(error, bits);
      least_error = error;
      best = mode;
      if (error == 0) break;  // those that follow have no fewer bits
    }
    if (last != best) predict(best);
    total_error += least_error;
    return best;
  };
  const PredMode luma_mode = choose(kLumaModes, [&](PredMode mode) {
    predict_luma(mode, borders, coded.samples);
    return luma_error(input.source, coded.samples);
  });
  coded.chroma_mode = choose(kChromaModes, [&](PredMode mode) {
    predict_chroma(mode, borders, coded.samples);
    return chroma_error(input.source, coded.samples);
  });
  if (largest_difference(input.source, coded.samples) > tolerance_) return coded;
  write_intra_type(input.slice_type, kI16x16 + static_cast<unsigned>(luma_mode), coded.bits);
  coded.bits.put_unsigned(chroma_number(coded.chroma_mode));
  coded.bits.put_signed(0);  // mb_qp_delta
  // Intra16x16DCLevel is never left out (7.3.5.3).
  write_levels(Levels{}, 0, nc_of(coded.state, input.neighbours, {0, 0}), coded.bits);
  set_cost(coded, total_error);
  return coded;
}

CodedMacroblock MacroblockCoder::p_moved(const MacroblockInput& input,
                                         std::int64_t cost_limit) const {
  const auto& [before, search, x_mb, y_mb] = input.reference;
  if (search == nullptr) return CodedMacroblock(MbType::p_l0_16x16);
  const auto vector = search->find(input.source, *before, x_mb, y_mb, input.neighbours);
  if (!vector || *vector == skip_vector(input.neighbours)) {
    return CodedMacroblock(MbType::p_l0_16x16);
  }
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): written right after
  Samples moved;
  predict_moved(*before, x_mb, y_mb, *vector, moved);
  return p_l0_16x16(input, *vector, moved, cost_limit);
}

CodedMacroblock MacroblockCoder::p_l0_16x16(const MacroblockInput& input, MotionVector vector,
                                            const Samples& predicted,
                                            std::int64_t cost_limit) const {
  CodedMacroblock coded(MbType::p_l0_16x16);
  coded.samples = predicted;
  coded.state.vector = vector;
  Residual residual;
  for (int index = 0; index < 16; ++index) {
    residual.code_luma(inter_.luma, luma_place(index), input.source, coded.samples);
  }
  residual.code_chroma(inter_.chroma, input.source, coded.samples);
  const int pattern = residual.coded_block_pattern();
  if (pattern == 0) {
    if (vector == skip_vector(input.neighbours)) return coded;  // it would be P_Skip
    if (largest_difference(input.source, coded.samples) > tolerance(vector)) return coded;
  }
  write_p_l0_16x16(vector, input.neighbours, coded.bits);
  finish(input, residual, pattern, cost_limit, coded);
  return coded;
}

CodedMacroblock MacroblockCoder::i_nxn(const MacroblockInput& input, const CodedMacroblock& i_16x16,
                                       std::int64_t cost_limit) const {
  CodedMacroblock coded(MbType::i_nxn);
  coded.samples = i_16x16.samples;
  Residual residual;
  write_intra_type(input.slice_type, kINxN, coded.bits);
  for (int index = 0; index < 16; ++index) {
    const BlockPlace place = luma_place(index);
    predict_block(input, place, coded);
    residual.code_luma(intra_.luma, place, input.source, coded.samples);
  }
  coded.bits.put_unsigned(chroma_number(i_16x16.chroma_mode));
  residual.code_chroma(intra_.chroma, input.source, coded.samples);
  finish(input, residual, residual.coded_block_pattern(), cost_limit, coded);
  return coded;
}

void MacroblockCoder::predict_block(const MacroblockInput& input, BlockPlace place,
                                    CodedMacroblock& coded) const {
  constexpr int kPredicted_bits = 1;
  constexpr int kOther_bits = 4;
  const AdjacentSamples adjacent = beside_block(input.borders, coded.samples, place);
  const int predicted = predicted_mode(coded.state, input.neighbours, place);
  const int offset = 4 * place.y * kLumaSide + 4 * place.x;
  const Block4x4 source = load_block(input.source.plane(0) + offset, kLumaSide);
  Block4x4 best{};
  int best_mode = 0;
  std::int64_t least_cost = CodedMacroblock::kImpossible;
  for (const int number : {predicted, 0, 1, 2}) {
    const auto mode = static_cast<PredMode>(number);
    if (!is_possible(mode, adjacent.above != nullptr, adjacent.left != nullptr)) continue;
    const Block4x4 block = predict_4x4(mode, adjacent);
    const std::int64_t block_cost = cost(squared_error(source.data(), block.data(), 16),
                                         number == predicted ? kPredicted_bits : kOther_bits);
    if (block_cost >= least_cost) continue;
    least_cost = block_cost;
    best = block;
    best_mode = number;
    if (block_cost <= cost(0, kOther_bits)) break;
  }
  store_block(best, coded.samples.plane(0) + offset, kLumaSide);
  coded.state.pred_modes[place.number()] = static_cast<std::uint8_t>(best_mode);
  // prev_intra4x4_pred_mode_flag and rem_intra4x4_pred_mode, 7.3.5.1.
  coded.bits.put_flag(best_mode == predicted);
  if (best_mode == predicted) return;
  coded.bits.put(static_cast<std::uint32_t>(best_mode - (best_mode > predicted ? 1 : 0)), 3);
}

void write_i_pcm(SliceType slice_type, const Samples& samples, BitWriter& bits) {
  write_intra_type(slice_type, kIPcm, bits);
  bits.align();
  for (const std::uint8_t value : samples.values) bits.put(value, 8);
}

}  // namespace piblocks::h264
