// Pictures of which little changes, as H.264.
// In: a picture, and which of its macroblocks may differ from the picture before. Out: an access
// unit: a slice that skips all the others.
//
// No vector is anything but zero, so that the one predicted for a skipped macroblock is zero too
// (8.4.1.1), and a picture can be made in the place of the one before it.
#pragma once

#include <cstdint>
#include <vector>

#include "h264/macroblock.hpp"
#include "h264/macroblock_set.hpp"
#include "h264/parameter_sets.hpp"
#include "h264/picture.hpp"

namespace piblocks::h264 {

/// Decoders have 16 bits for what they add up of a block's coefficients (8.5.12): 16320 stands for
/// the largest difference that a sample can have, and rounding adds up to 5/6 of the steps of all
/// 16 coefficients, to 31000 in all at 41. At 51, libavcodec has shown 0 in place of 255.
inline constexpr int kMaxQp = 41;

class PictureEncoder {
 public:
  /// @param qp  from 0 to kMaxQp.
  PictureEncoder(const ParameterSets& sets, int qp);

  /// An IDR picture, with which a decoder can begin, with a start code of four bytes.
  std::vector<std::uint8_t> encode_whole(const Picture& source);
  /// The next picture.
  std::vector<std::uint8_t> encode_changes(const Picture& source, const MacroblockSet& changed);

  /// The last picture as every decoder has it.
  const Picture& decoded() const noexcept { return decoded_; }
  /// How many macroblocks of the last picture neither stayed nor were predicted whole.
  int transformed_macroblocks() const noexcept { return transformed_; }

 private:
  void begin_slice(SliceKind slice);
  void write_slice_header(SliceKind slice);
  void add(int address, const Picture& source);
  std::vector<std::uint8_t> finish_slice();

  ParameterSets sets_;
  int qp_;
  MacroblockCoder coder_;
  Picture decoded_;
  std::vector<MacroblockState> states_;
  std::vector<int> coded_;  // addresses whose states are to be forgotten
  MacroblockInput input_{};
  BitWriter bits_;
  int next_address_ = 0;  // after the last one that is in the slice
  std::uint32_t frame_num_ = 0;
  int transformed_ = 0;
};

}  // namespace piblocks::h264
