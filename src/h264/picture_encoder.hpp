// Pictures of which little changes, as H.264.
// In: the parts of a picture that may differ from the picture before. Out: an access unit of one
// slice, which skips all macroblocks that do not differ.
//
// Where nothing moves by whole samples, all motion vectors are zero, and so are those predicted for
// skipped macroblocks (8.4.1.1). P_Skip beside a macroblock with another vector may
// mean that vector; what stays there gets a vector of zero.
#pragma once

#include <cstdint>
#include <vector>

#include "h264/macroblock.hpp"
#include "h264/motion.hpp"
#include "h264/picture.hpp"

namespace piblocks::h264 {

/// Decoders add up a block's coefficients in 16 bits (8.5.12.2). The largest difference of a sample
/// takes 16320; rounding adds up to 5/6 of the steps of all 16 coefficients, in all 31000 at QP 41.
/// At QP 51, libavcodec has shown 0 where 255 is right.
inline constexpr int kMaxQp = 41;

using Bytes = std::vector<std::uint8_t>;

class PictureEncoder {
 public:
  /// @param config  of size and qp; the qp is at most kMaxQp
  explicit PictureEncoder(const Config& config);

  /// Takes a part of the next picture; the other samples are those of the picture before.
  /// @param rect  of even numbers, from 0; what reaches out of the picture is cut off
  /// @param part  the samples of the rectangle alone
  void take(const Planes& part, Rect rect);
  /// An IDR picture. Macroblocks keep the bits of the last one where they are coded alike, which
  /// changes no byte.
  /// @param unit  is replaced by the access unit, with a start code of four bytes
  void encode_idr(Bytes& unit);
  void encode_p(Bytes& unit);

  /// The last picture as every decoder has it.
  const Picture& decoded() const noexcept { return decoded_; }
  /// How many macroblocks of the last P picture have coefficients or are I_PCM.
  int transformed_macroblocks() const noexcept { return transformed_; }

 private:
  /// What the last IDR picture says of its macroblocks.
  struct LastIdr {
    LastIdr(int width_mb, int height_mb) : changed(width_mb, height_mb) {}

    bool is_valid = false;
    MacroblockSet changed;  ///< since then, in the source
    std::vector<MacroblockState> states;
    BitWriter slice;
    std::vector<std::size_t> starts;  ///< of each macroblock's bits in the slice, and its end
  };

  void begin_picture();
  void begin_slice(SliceType type);
  void encode_all();
  /// Whether the bits of the macroblock in the last IDR picture cannot be used: its source has
  /// changed since, or the macroblock left of it or above it has another result.
  bool needs_coding(int address) const;
  /// Whether the macroblock now has other samples or another state than in the last IDR picture.
  bool has_new_result(int address, const CodedMacroblock& coded);
  /// Takes the bits of macroblocks from `begin` to before `end` out of the last IDR picture.
  void repeat(int begin, int end);
  /// Sets what a macroblock is predicted from. @returns its vector as P_Skip
  MotionVector enter(int address);
  void add(int address);
  /// A macroblock that does not change, beside some that may move.
  void keep(int address);
  void put(int address, const CodedMacroblock& coded);
  void finish_slice(Bytes& unit);

  int width_px_;
  int height_px_;
  int width_mb_;
  int height_mb_;
  MacroblockCoder coder_;
  MotionSearch motion_;
  Picture source_;
  Picture before_;  // the decoded picture before the last
  Picture decoded_;
  MacroblockSet taken_;    // what differs in the source of the next picture
  MacroblockSet changed_;  // the same of the picture that is made
  MacroblockSet visited_;  // what changes, and what is beside motion
  std::vector<MacroblockState> states_;
  std::vector<int> coded_;  // addresses of the macroblocks whose states are set
  MacroblockInput input_{};
  BitWriter bits_;
  LastIdr last_idr_;
  std::vector<std::size_t> starts_;  // as in LastIdr, of the IDR picture that is being made
  std::vector<std::uint8_t> has_new_result_;  // of each macroblock of this IDR picture
  bool has_i_pcm_ = false;  // the slice has I_PCM, whose bits depend on where they are
  int next_address_ = 0;    // after the last macroblock that is not skipped
  std::uint32_t frame_num_ = 0;
  unsigned idr_pic_id_ = 1;
  bool is_after_idr_ = false;
  int transformed_ = 0;
};

}  // namespace piblocks::h264
