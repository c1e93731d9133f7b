// What a stream's headers say of its slices.
// In: the sequence and the picture parameter set that an encoder made. Out: the numbers that
// slices of our own need, if these are slices that we can write.
#pragma once

#include <cstdint>
#include <span>

namespace piblocks::h264 {

/// Of ITU-T H.264, 7.4.2.1 and 7.4.2.2.
struct ParameterSets {
  int width_mb;   ///< PicWidthInMbs
  int height_mb;  ///< FrameHeightInMbs
  int log2_max_frame_num;
  unsigned picture_parameter_set_id;
  /// Whether slices have to say that they have one reference picture.
  bool overrides_reference_count;
  int initial_qp;        ///< 26 + pic_init_qp_minus26
  int chroma_qp_offset;  ///< chroma_qp_index_offset
};

/// Reads one sequence and one picture parameter set, in this order, from a stream with start codes.
/// Accepts frames in 4:2:0 with 8 bits, CAVLC, picture order type 2, no field or slice-group
/// coding, no redundant pictures, no weighted prediction, no constrained intra prediction, no 8x8
/// transform, no lossless macroblocks, no scaling matrices, and deblocking that slices can switch
/// off. Units of other types are passed over.
/// @throws HeaderError naming what is missing, broken or not one of these.
ParameterSets read_parameter_sets(std::span<const std::uint8_t> stream);

}  // namespace piblocks::h264
