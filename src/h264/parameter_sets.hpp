// What the headers of a stream say: the sequence and the picture parameter set.
// In: a config. Out: the headers of our own stream. Or, in: the headers of another encoder. Out:
// the numbers that its slices are coded with.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "h264/encoder.hpp"

namespace piblocks::h264 {

/// Of ITU-T H.264, 7.4.2.1 and 7.4.2.2.
struct ParameterSets {
  int width_mb;   ///< PicWidthInMbs
  int height_mb;  ///< FrameHeightInMbs
  int log2_max_frame_num;
  unsigned picture_parameter_set_id;
  bool overrides_reference_count;  ///< slices need num_ref_idx_active_override_flag
  int initial_qp;                  ///< 26 + pic_init_qp_minus26
  int chroma_qp_offset;            ///< chroma_qp_index_offset

  /// Slices that are coded with equal numbers may follow one another under one pair of headers.
  bool operator==(const ParameterSets&) const = default;
};

/// Those of our own stream: what libx264 codes its slices with in its preset ultrafast, at this
/// quantiser.
ParameterSets parameter_sets(const Config& config);

/// The same as headers, with start codes, for a stream of this level: Constrained Baseline, BT.709
/// limited, square pixels, a fixed rate, one reference picture, no reordering (7.3.2.1, 7.3.2.2,
/// E.1.1).
std::vector<std::uint8_t> write_parameter_sets(const Config& config, int level_idc);

/// Reads one sequence and one picture parameter set, in this order, from a stream with start codes,
/// and ignores other units.
/// Accepts frames in 4:2:0 with 8 bits, CAVLC, picture order type 2, no field or slice-group
/// coding, no redundant pictures, no weighted prediction, no constrained intra prediction, no 8x8
/// transform, no lossless macroblocks, no scaling matrices, and deblocking that slices can switch
/// off.
/// @throws HeaderError naming what is missing, broken or not accepted.
ParameterSets read_parameter_sets(std::span<const std::uint8_t> stream);

}  // namespace piblocks::h264
