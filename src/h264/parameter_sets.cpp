#include "h264/parameter_sets.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "h264/bit_stream.hpp"
#include "h264/nal_unit.hpp"
#include "h264/picture.hpp"

namespace piblocks::h264 {
namespace {

/// Ends the comparison of headers. may_follow() catches it.
void require(bool is_alike) {
  if (!is_alike) throw HeaderError("h264: slices of these headers are coded otherwise");
}

/// The profiles with more fields in their sequence parameter sets, 7.3.2.1.1.
bool is_high_profile(std::uint32_t profile) {
  constexpr std::array<std::uint32_t, 13> kProfiles = {100, 110, 122, 244, 44,  83, 86,
                                                       118, 128, 138, 139, 134, 135};
  return std::ranges::find(kProfiles, profile) != kProfiles.end();
}

/// seq_parameter_set_data(), 7.3.2.1.1, up to what only says how pictures are shown.
void compare_sequence(BitReader bits, const Config& config) {
  const std::uint32_t profile = bits.get(8);
  bits.get(16);                       // constraint flags, level
  require(bits.get_unsigned() == 0);  // seq_parameter_set_id
  if (is_high_profile(profile)) {
    require(bits.get_unsigned() == 1);  // chroma_format_idc: 4:2:0
    require(bits.get_unsigned() == 0);  // bit_depth_luma_minus8
    require(bits.get_unsigned() == 0);  // bit_depth_chroma_minus8
    require(!bits.get_flag());          // qpprime_y_zero_transform_bypass_flag
    require(!bits.get_flag());          // seq_scaling_matrix_present_flag
  }
  require(bits.get_unsigned() == kFrameNum_bits - 4);
  require(bits.get_unsigned() == 2);  // pic_order_cnt_type
  require(bits.get_unsigned() == 1);  // max_num_ref_frames
  bits.get_flag();                    // gaps_in_frame_num_value_allowed_flag
  require(bits.get_unsigned() == static_cast<unsigned>(macroblocks_along(config.width_px) - 1));
  require(bits.get_unsigned() == static_cast<unsigned>(macroblocks_along(config.height_px) - 1));
  require(bits.get_flag());  // frame_mbs_only_flag
}

/// pic_parameter_set_rbsp(), 7.3.2.2.
void compare_picture(BitReader bits, const Config& config) {
  require(bits.get_unsigned() == 0);  // pic_parameter_set_id
  require(bits.get_unsigned() == 0);  // seq_parameter_set_id
  require(!bits.get_flag());          // entropy_coding_mode_flag: CAVLC
  bits.get_flag();                    // bottom_field_pic_order_in_frame_present_flag
  require(bits.get_unsigned() == 0);  // num_slice_groups_minus1
  require(bits.get_unsigned() == 0);  // num_ref_idx_l0_default_active_minus1
  bits.get_unsigned();                // num_ref_idx_l1_default_active_minus1
  require(!bits.get_flag());          // weighted_pred_flag
  bits.get(2);                        // weighted_bipred_idc: of B slices
  require(bits.get_signed() == config.qp - 26);
  bits.get_signed();                // pic_init_qs_minus26
  require(bits.get_signed() == 0);  // chroma_qp_index_offset
  require(bits.get_flag());         // deblocking_filter_control_present_flag
  require(!bits.get_flag());        // constrained_intra_pred_flag
  require(!bits.get_flag());        // redundant_pic_cnt_present_flag
  if (!bits.has_more_data()) return;
  require(!bits.get_flag());        // transform_8x8_mode_flag
  require(!bits.get_flag());        // pic_scaling_matrix_present_flag
  require(bits.get_signed() == 0);  // second_chroma_qp_index_offset
  require(!bits.has_more_data());
}

/// vui_parameters(), E.1.1
void write_usability(const Config& config, BitWriter& bits) {
  bits.put_flag(true);                               // aspect_ratio_info_present_flag
  bits.put(1, 8);                                    // aspect_ratio_idc: square
  bits.put_flag(false);                              // overscan_info_present_flag
  bits.put_flag(true);                               // video_signal_type_present_flag
  bits.put(5, 3);                                    // video_format: unspecified
  bits.put_flag(false);                              // video_full_range_flag
  bits.put_flag(true);                               // colour_description_present_flag
  for (int i = 0; i < 3; ++i) bits.put(1, 8);        // primaries, transfer, matrix: BT.709
  bits.put_flag(true);                               // chroma_loc_info_present_flag
  for (int i = 0; i < 2; ++i) bits.put_unsigned(0);  // chroma samples lie left
  bits.put_flag(true);                               // timing_info_present_flag
  bits.put(static_cast<std::uint32_t>(config.rate_denominator), 32);    // num_units_in_tick
  bits.put(static_cast<std::uint32_t>(2 * config.rate_numerator), 32);  // time_scale: of fields
  bits.put_flag(true);                                                  // fixed_frame_rate_flag
  for (int i = 0; i < 3; ++i) bits.put_flag(false);  // no HRD of NAL or VCL, no pic_struct
  bits.put_flag(true);                               // bitstream_restriction_flag
  bits.put_flag(true);                               // motion_vectors_over_pic_boundaries_flag
  for (int i = 0; i < 2; ++i)
    bits.put_unsigned(0);  // no limit of bytes or bits besides the level's
  bits.put_unsigned(13);   // log2_max_mv_length_horizontal: 2048 samples, in quarters
  bits.put_unsigned(11);   // log2_max_mv_length_vertical: 512 samples
  bits.put_unsigned(0);    // max_num_reorder_frames
  bits.put_unsigned(1);    // max_dec_frame_buffering
}

/// seq_parameter_set_rbsp(), 7.3.2.1
void write_sequence(const Config& config, int level_idc, BitWriter& bits) {
  constexpr unsigned kBaseline = 66;
  constexpr unsigned kConstrained = 0xC0;  // constraint_set0_flag and constraint_set1_flag
  const int width_mb = macroblocks_along(config.width_px);
  const int height_mb = macroblocks_along(config.height_px);
  bits.put(kBaseline, 8);
  bits.put(kConstrained, 8);
  bits.put(static_cast<unsigned>(level_idc), 8);
  bits.put_unsigned(0);  // seq_parameter_set_id
  bits.put_unsigned(kFrameNum_bits - 4);
  bits.put_unsigned(2);  // pic_order_cnt_type: the order of decoding
  bits.put_unsigned(1);  // max_num_ref_frames
  bits.put_flag(false);  // gaps_in_frame_num_value_allowed_flag
  bits.put_unsigned(static_cast<unsigned>(width_mb - 1));
  bits.put_unsigned(static_cast<unsigned>(height_mb - 1));
  bits.put_flag(true);  // frame_mbs_only_flag
  bits.put_flag(true);  // direct_8x8_inference_flag
  const int right_px = kLumaSide * width_mb - config.width_px;
  const int below_px = kLumaSide * height_mb - config.height_px;
  bits.put_flag(right_px > 0 || below_px > 0);  // frame_cropping_flag
  if (right_px > 0 || below_px > 0) {
    bits.put_unsigned(0);
    bits.put_unsigned(static_cast<unsigned>(right_px / 2));
    bits.put_unsigned(0);
    bits.put_unsigned(static_cast<unsigned>(below_px / 2));
  }
  bits.put_flag(true);  // vui_parameters_present_flag
  write_usability(config, bits);
  bits.put_trailing_bits();
}

/// pic_parameter_set_rbsp(), 7.3.2.2
void write_picture(const Config& config, BitWriter& bits) {
  bits.put_unsigned(0);  // pic_parameter_set_id
  bits.put_unsigned(0);  // seq_parameter_set_id
  bits.put_flag(false);  // entropy_coding_mode_flag: CAVLC
  bits.put_flag(false);  // bottom_field_pic_order_in_frame_present_flag
  bits.put_unsigned(0);  // num_slice_groups_minus1
  bits.put_unsigned(0);  // num_ref_idx_l0_default_active_minus1
  bits.put_unsigned(0);  // num_ref_idx_l1_default_active_minus1
  bits.put_flag(false);  // weighted_pred_flag
  bits.put(0, 2);        // weighted_bipred_idc
  bits.put_signed(config.qp - 26);
  bits.put_signed(0);    // pic_init_qs_minus26
  bits.put_signed(0);    // chroma_qp_index_offset
  bits.put_flag(true);   // deblocking_filter_control_present_flag
  bits.put_flag(false);  // constrained_intra_pred_flag
  bits.put_flag(false);  // redundant_pic_cnt_present_flag
  bits.put_trailing_bits();
}

}  // namespace

std::vector<std::uint8_t> write_parameter_sets(const Config& config, int level_idc) {
  constexpr int kImportant = 3;  // nal_ref_idc
  std::vector<std::uint8_t> headers;
  BitWriter sequence;
  write_sequence(config, level_idc, sequence);
  append_unit(UnitType::sequence_parameters, kImportant, sequence.bytes(), headers);
  BitWriter picture;
  write_picture(config, picture);
  append_unit(UnitType::picture_parameters, kImportant, picture.bytes(), headers);
  return headers;
}

int profile_idc(std::span<const std::uint8_t> headers) {
  const std::vector<Unit> units = read_units(headers);
  const auto set =
      std::ranges::find(units, static_cast<int>(UnitType::sequence_parameters), &Unit::type);
  return set == units.end() || set->rbsp.empty() ? 0 : set->rbsp[0];
}

bool may_follow(std::span<const std::uint8_t> headers, const Config& config) {
  constexpr auto kSequence = static_cast<int>(UnitType::sequence_parameters);
  constexpr auto kPicture = static_cast<int>(UnitType::picture_parameters);
  std::vector<Unit> units = read_units(headers);
  std::erase_if(units, [](const Unit& u) { return u.type != kSequence && u.type != kPicture; });
  if (units.size() != 2 || units[0].type != kSequence || units[1].type != kPicture) return false;
  try {
    compare_sequence(BitReader(units[0].rbsp), config);
    compare_picture(BitReader(units[1].rbsp), config);
  } catch (const HeaderError&) {
    return false;
  }
  return true;
}

}  // namespace piblocks::h264
