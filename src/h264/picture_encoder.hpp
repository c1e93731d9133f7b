// Pictures of which little changes, as H.264.
// In: a picture, and which of its macroblocks may differ from the picture before. Out: an access
// unit of one slice, which skips all other macroblocks.
//
// All motion vectors are zero. So are the vectors predicted for skipped macroblocks (8.4.1.1), and
// a picture can be decoded over the one before it.
#pragma once

#include <cstdint>
#include <vector>

#include "h264/macroblock.hpp"
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
  /// How many macroblocks of the last picture are neither P_Skip nor I_16x16.
  int transformed_macroblocks() const noexcept { return transformed_; }

 private:
  void begin_slice(SliceType type);
  void add(int address, const Picture& source);
  std::vector<std::uint8_t> finish_slice();

  ParameterSets sets_;
  int qp_;
  MacroblockCoder coder_;
  Picture decoded_;
  std::vector<MacroblockState> states_;
  std::vector<int> coded_;  // addresses of the macroblocks whose states are set
  MacroblockInput input_{};
  BitWriter bits_;
  int next_address_ = 0;  // after the last macroblock that is not skipped
  std::uint32_t frame_num_ = 0;
  int transformed_ = 0;
};

}  // namespace piblocks::h264
