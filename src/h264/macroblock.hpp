// How one macroblock is coded: by the cheapest mb_type, in bits and in error.
// In: what it should show, what is beside it and what was there before. Out: macroblock_layer() of
// ITU-T H.264, 7.3.5, and the samples that every decoder makes of it.
#pragma once

#include <cstdint>
#include <limits>

#include "h264/bit_stream.hpp"
#include "h264/intra_prediction.hpp"
#include "h264/motion.hpp"
#include "h264/picture.hpp"
#include "h264/residual.hpp"

namespace piblocks::h264 {

enum class SliceType : std::uint8_t { p, i };

/// mb_type, tables 7-11 and 7-13, as far as it is used here.
enum class MbType : std::uint8_t {
  p_skip,   ///< stays as it was
  i_16x16,  ///< without coefficients
  p_l0_16x16,
  i_nxn,  ///< of 4x4 blocks
  i_pcm
};

/// A macroblock's place, and the decoded picture before, in which its motion is looked for.
struct Reference {
  const Picture* before = nullptr;
  MotionSearch* search = nullptr;  ///< null: no motion is looked for
  int x_mb = 0;
  int y_mb = 0;
};

struct MacroblockInput {
  SliceType slice_type{};
  Samples source;
  Samples before;  ///< of the decoded picture before, by the vector of P_Skip; not used in I slices
  Borders borders{};
  Neighbours neighbours{};
  Reference reference{};  ///< not used in I slices
};

struct CodedMacroblock {
  static constexpr std::int64_t kImpossible = std::numeric_limits<std::int64_t>::max();

  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): samples are written right after
  explicit CodedMacroblock(MbType mb_type) : type(mb_type) {
    state.is_intra = mb_type != MbType::p_skip && mb_type != MbType::p_l0_16x16;
  }

  MbType type;
  PredMode chroma_mode{};  ///< of intra types
  Samples samples;         ///< as decoders have them
  MacroblockState state{};
  bool has_residual = false;
  BitWriter bits{};  ///< empty for P_Skip and I_PCM; write_i_pcm() writes the latter
  std::int64_t cost = kImpossible;
};

class MacroblockCoder {
 public:
  /// @param qp  QPY, the same for all macroblocks, from 0 to 51.
  explicit MacroblockCoder(int qp);

  CodedMacroblock code(const MacroblockInput& input) const;
  /// Codes a macroblock of a P slice as what was there before, though P_Skip would move it.
  static CodedMacroblock hold(const Samples& before, const Neighbours& neighbours);

 private:
  struct Quantisers {
    Quantiser luma;
    Quantiser chroma;
  };

  // Each codes the macroblock by one mb_type. The cost stays kImpossible if that would leave too
  // large an error or take too many bits, and may stay so if it would be cost_limit or more.
  CodedMacroblock p_skip(const MacroblockInput& input) const;
  CodedMacroblock i_16x16(const MacroblockInput& input) const;
  /// By the vector that the search finds, if there is one.
  CodedMacroblock p_moved(const MacroblockInput& input, std::int64_t cost_limit) const;
  CodedMacroblock p_l0_16x16(const MacroblockInput& input, MotionVector vector,
                             const Samples& predicted, std::int64_t cost_limit) const;
  /// Its chroma is predicted as that of `i_16x16`.
  CodedMacroblock i_nxn(const MacroblockInput& input, const CodedMacroblock& i_16x16,
                        std::int64_t cost_limit) const;
  /// Predicts one luma block of I_NxN into the macroblock, and writes its mode.
  void predict_block(const MacroblockInput& input, BlockPlace place, CodedMacroblock& coded) const;
  /// For an error and so many bits, in 1024ths of a squared error.
  std::int64_t cost(int squared_error, std::int64_t bits) const {
    return (std::int64_t{squared_error} << 10) + lambda_ * bits;
  }
  /// The bits with which a type costs no more than the limit.
  std::size_t bits_below(std::int64_t cost_limit, int squared_error) const {
    const std::int64_t left = cost_limit - cost(squared_error, 0);
    return left <= 0 ? 0 : static_cast<std::size_t>(left / lambda_);
  }
  void set_cost(CodedMacroblock& coded, int squared_error) const;
  /// Writes coded_block_pattern and the residual, if there is any, and sets the cost.
  void finish(const MacroblockInput& input, const Residual& residual, int pattern,
              std::int64_t cost_limit, CodedMacroblock& coded) const;

  /// The largest difference that may stay where nothing corrects it.
  int tolerance(MotionVector vector) const {
    return vector == MotionVector{} ? tolerance_ : 2 * tolerance_;
  }

  std::int64_t lambda_;  // what a bit costs
  int tolerance_;        // of what stays
  Quantisers intra_;
  Quantisers inter_;
};

/// mb_type I_PCM and the samples, which begin at a whole byte (7.3.5).
void write_i_pcm(SliceType slice_type, const Samples& samples, BitWriter& bits);

}  // namespace piblocks::h264
