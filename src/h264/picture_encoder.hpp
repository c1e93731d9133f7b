// Pictures of which little changes, as H.264.
// In: a picture, and which of its macroblocks may differ from the picture before. Out: an access
// unit of one slice, which skips all other macroblocks.
//
// Where nothing moves by whole samples, all motion vectors are zero, and so are those predicted for
// skipped macroblocks (8.4.1.1). Beside a macroblock with another vector, those that would move
// with it are told to stay.
#pragma once

#include <cstdint>
#include <vector>

#include "h264/macroblock.hpp"
#include "h264/motion.hpp"
#include "h264/parameter_sets.hpp"
#include "h264/picture.hpp"

namespace piblocks::h264 {

/// Decoders add up a block's coefficients in 16 bits (8.5.12.2). The largest difference of a sample
/// takes 16320; rounding adds up to 5/6 of the steps of all 16 coefficients, in all 31000 at QP 41.
/// At QP 51, libavcodec has shown 0 where 255 is right.
inline constexpr int kMaxQp = 41;

class PictureEncoder {
 public:
  /// @param qp  from 0 to kMaxQp.
  PictureEncoder(const ParameterSets& sets, int qp);

  /// An IDR picture, with a start code of four bytes.
  std::vector<std::uint8_t> encode_idr(const Picture& source);
  /// The next picture.
  std::vector<std::uint8_t> encode_p(const Picture& source, const MacroblockSet& changed);

  /// The last picture as every decoder has it.
  const Picture& decoded() const noexcept { return decoded_; }
  /// How many macroblocks of the last picture have coefficients or are I_PCM.
  int transformed_macroblocks() const noexcept { return transformed_; }

 private:
  void begin_slice(SliceType type);
  /// Whether the macroblock is not what it was in the source before.
  bool is_new(int address, const Picture& source);
  /// Sets what a macroblock is predicted from. @returns its vector as P_Skip
  MotionVector enter(int address);
  void add(int address, const Picture& source);
  /// A macroblock that does not change, beside some that may move.
  void keep(int address);
  void put(int address, const CodedMacroblock& coded);
  std::vector<std::uint8_t> finish_slice();

  ParameterSets sets_;
  int qp_;
  MacroblockCoder coder_;
  MotionSearch motion_;
  Picture source_before_;
  Picture before_;  // decoded
  Picture decoded_;
  MacroblockSet visited_;  // what changes, and what is beside motion
  std::vector<MacroblockState> states_;
  std::vector<int> coded_;  // addresses of the macroblocks whose states are set
  MacroblockInput input_{};
  BitWriter bits_;
  int next_address_ = 0;  // after the last macroblock that is not skipped
  std::uint32_t frame_num_ = 0;
  int transformed_ = 0;
};

}  // namespace piblocks::h264
