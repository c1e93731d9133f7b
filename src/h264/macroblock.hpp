// How one macroblock is coded: the cheapest of the modes, in bits and in error.
// In: what it should be, what is beside it and what was there before. Out: macroblock_layer() of
// ITU-T H.264, 7.3.5, and the samples that every decoder makes of it.
#pragma once

#include <array>
#include <cstdint>

#include "h264/bit_writer.hpp"
#include "h264/intra_prediction.hpp"
#include "h264/macroblock_state.hpp"
#include "h264/picture.hpp"
#include "h264/residual.hpp"

namespace piblocks::h264 {

enum class SliceKind : std::uint8_t { p, i };

struct MacroblockInput {
  SliceKind slice{};
  Samples source;
  Samples before;  ///< of the picture before, as decoders have it; not used in I slices
  Borders borders{};
  Neighbours beside{};
};

/// mb_type, tables 7-11 and 7-13, as far as it is used here.
enum class MacroblockKind : std::uint8_t {
  p_skip,      ///< stays as it was
  i_16x16,     ///< without coefficients
  p_l0_16x16,  ///< without motion
  i_nxn,       ///< of 4x4
  i_pcm
};

struct CodedMacroblock {
  MacroblockKind kind{};
  Samples samples;
  MacroblockState state;
  BitWriter bits;  ///< none of P_Skip and I_PCM; write_i_pcm() writes the latter in its place
};

/// A prediction mode, and how many bits it takes to write it.
struct ModeCost {
  Prediction prediction;
  int bits;
};
using ModeCosts = std::array<ModeCost, 3>;

class MacroblockCoder {
 public:
  /// @param qp  QPy, the same for all, from 0 to 51.
  /// @param chroma_qp_offset  chroma_qp_index_offset
  MacroblockCoder(int qp, int chroma_qp_offset);
  ~MacroblockCoder() = default;
  MacroblockCoder(const MacroblockCoder&) = delete;
  MacroblockCoder& operator=(const MacroblockCoder&) = delete;

  /// The result stays until the next call.
  const CodedMacroblock& code(const MacroblockInput& input);

 private:
  struct Candidate {
    Prediction prediction;
    int error;
  };

  void try_skip(const MacroblockInput& input);
  /// Predicts with the cheapest of the modes.
  /// @param predict  does so, and returns the squared error.
  template <typename Predict>
  Candidate predict_best(const ModeCosts& modes, const Borders& borders, Predict predict);
  void predict_i_16x16(const MacroblockInput& input);
  void try_i_16x16(const MacroblockInput& input);
  void try_p_l0_16x16(const MacroblockInput& input);
  void try_i_nxn(const MacroblockInput& input);
  void take_i_pcm(const MacroblockInput& input);
  /// Keeps the trial if it costs less than the best so far.
  void judge(MacroblockKind kind, int squared_error);
  /// Whether no type with at least so many bits can be cheaper than the best so far.
  bool is_beyond(int bits) const { return best_cost_ <= lambda_ * bits; }
  static std::int64_t error_cost(int squared_error) { return std::int64_t{squared_error} << 10; }
  /// Predicts a block of 4x4 of the trial, and writes its mode and coefficients.
  void code_4x4_block(const MacroblockInput& input, BlockPlace place);

  std::int64_t lambda_;  // what a bit costs, in 1024ths of a squared error
  int largest_left_;     // difference that may stay where nothing mends it
  Quantisers intra_;
  Quantisers inter_;
  std::array<CodedMacroblock, 2> memory_{};
  CodedMacroblock* best_ = memory_.data();
  CodedMacroblock* trial_ = memory_.data() + 1;
  Residual residual_{};
  Samples predicted_;  // as well as neighbours can
  Prediction luma_prediction_{};
  Prediction chroma_prediction_{};
  int predicted_error_ = 0;
  std::int64_t best_cost_ = 0;
};

/// mb_type I_PCM and the samples, which have to begin at a whole byte (7.3.5).
void write_i_pcm(SliceKind slice, const Samples& samples, BitWriter& bits);

}  // namespace piblocks::h264
