// How one macroblock is coded: the cheapest of the ways, in bits and in error.
// In: what it should be, what is beside it and what was there before. Out: macroblock_layer() of
// ITU-T H.264, 7.3.5, and the samples that every decoder makes of it.
#pragma once

#include <array>
#include <cstdint>

#include "media/h264/bit_writer.hpp"
#include "media/h264/intra_prediction.hpp"
#include "media/h264/macroblock_state.hpp"
#include "media/h264/picture.hpp"
#include "media/h264/residual.hpp"

namespace piblocks::h264 {

enum class SliceKind : std::uint8_t { p, i };

struct MacroblockInput {
  SliceKind slice{};
  Samples source;
  Samples before;  ///< of the picture before, as decoders have it; not used in I slices
  Borders borders{};
  Neighbours beside{};
};

enum class MacroblockKind : std::uint8_t {
  skipped,     ///< stays as it was: P_Skip
  predicted,   ///< I_16x16 that is all prediction
  difference,  ///< P_L0_16x16 without motion
  squares,     ///< I_NxN of 4x4
  samples      ///< I_PCM
};

struct CodedMacroblock {
  MacroblockKind kind{};
  Samples samples;
  MacroblockState state;
  BitWriter bits;  ///< none if skipped; those of `samples` have to be written where they stand
};

/// A way to predict, and how many bits it takes to say so.
struct Way {
  Prediction prediction;
  int bits;
};
using Ways = std::array<Way, 3>;

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
  struct Guess {
    Prediction prediction;
    int error;
  };

  void try_skip(const MacroblockInput& input);
  /// Predicts with the cheapest of the ways.
  /// @param predict  does so, and returns the squared error.
  template <typename Predict>
  Guess predict_best(const Ways& ways, const Borders& borders, Predict predict);
  void predict_best_samples(const MacroblockInput& input);
  void try_prediction(const MacroblockInput& input);
  void try_difference(const MacroblockInput& input);
  void try_squares(const MacroblockInput& input);
  void take_samples(const MacroblockInput& input);
  /// Keeps the trial if it costs less than the best so far.
  void judge(MacroblockKind kind, int squared_error);
  /// Whether no way with at least so many bits can be cheaper than the best so far.
  bool is_beyond(int bits) const { return best_cost_ <= lambda_ * bits; }
  static std::int64_t error_cost(int squared_error) { return std::int64_t{squared_error} << 10; }
  /// Predicts a square of the trial, and writes how.
  void predict_best_square(const MacroblockInput& input, BlockPlace place);

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
void write_samples(SliceKind slice, const Samples& samples, BitWriter& bits);

}  // namespace piblocks::h264
