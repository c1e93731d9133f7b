// What a stream's headers say about its slices, and how large and fast a stream can be.
// In: the sequence and picture parameter sets of another encoder. Out: the numbers that our own
// slices in its stream need.
#pragma once

#include <cstdint>
#include <span>
#include <string>

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
};

/// Reads one sequence and one picture parameter set, in this order, from a stream with start codes,
/// and ignores other units.
/// Accepts frames in 4:2:0 with 8 bits, CAVLC, picture order type 2, no field or slice-group
/// coding, no redundant pictures, no weighted prediction, no constrained intra prediction, no 8x8
/// transform, no lossless macroblocks, no scaling matrices, and deblocking that slices can switch
/// off.
/// @throws HeaderError naming what is missing, broken or not accepted.
ParameterSets read_parameter_sets(std::span<const std::uint8_t> stream);

/// MaxFS of level 6.2, which allows all that any level does: macroblocks of a picture (ITU-T H.264
/// (08/2021), table A-1).
inline constexpr std::int64_t kMaxPicture_mb = 139'264;
/// The longest side of a picture: floor(Sqrt(8 MaxFS)), by A.3.1, items f and g.
inline constexpr std::int64_t kMaxSide_mb = 1055;
static_assert(kMaxSide_mb * kMaxSide_mb <= 8 * kMaxPicture_mb &&
              (kMaxSide_mb + 1) * (kMaxSide_mb + 1) > 8 * kMaxPicture_mb);

/// Empty if level 6.2 allows such pictures at the rate numerator / denominator a second; else which
/// of its limits they exceed.
/// @param rate_numerator, rate_denominator  1 … 2^31 - 1
std::string level_problem(int width_px, int height_px, std::int64_t rate_numerator,
                          std::int64_t rate_denominator);

}  // namespace piblocks::h264
