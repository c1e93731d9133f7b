#include "h264/parameter_sets.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "h264/bit_stream.hpp"
#include "h264/levels.hpp"
#include "h264/nal_unit.hpp"
#include "h264/picture.hpp"
#include "h264/text.hpp"

namespace piblocks::h264 {
namespace {

void refuse_if(bool is_other, std::string_view property) {
  if (is_other) throw HeaderError(text("h264: cannot continue a stream with ", property));
}

template <typename Number>
Number in_range(Number value, Number least, Number most, std::string_view name) {
  if (least <= value && value <= most) return value;
  throw HeaderError(
      text("h264: ", name, " of a header is ", value, ", not in [", least, ", ", most, "]"));
}

/// The profiles with more fields in their sequence parameter sets, 7.3.2.1.1.
bool is_high_profile(std::uint32_t profile) {
  constexpr std::array<std::uint32_t, 13> kProfiles = {100, 110, 122, 244, 44,  83, 86,
                                                       118, 128, 138, 139, 134, 135};
  return std::ranges::find(kProfiles, profile) != kProfiles.end();
}

void read_high_profile_fields(BitReader& bits) {
  refuse_if(bits.get_unsigned() != 1, "chroma other than 4:2:0");
  for (int i = 0; i < 2; ++i) refuse_if(bits.get_unsigned() != 0, "samples of more than 8 bits");
  refuse_if(bits.get_flag(), "lossless macroblocks");  // qpprime_y_zero_transform_bypass_flag
  refuse_if(bits.get_flag(), "scaling matrices");
}

/// @param size  in samples; offsets are in pairs of samples.
void read_cropping(BitReader& bits, std::uint32_t size, std::string_view name) {
  const std::uint64_t before = bits.get_unsigned();
  const std::uint64_t after = bits.get_unsigned();
  if (2 * (before + after) >= size) {
    throw HeaderError(text("h264: nothing is left of a picture's ", name, " ", size));
  }
}

/// seq_parameter_set_data(), 7.3.2.1.1, up to the VUI, which is its end.
/// @return seq_parameter_set_id
std::uint32_t read_sequence(BitReader bits, ParameterSets& sets) {
  const std::uint32_t profile = bits.get(8);
  bits.get(16);  // constraint flags, level
  const std::uint32_t id = in_range(bits.get_unsigned(), 0U, 31U, "seq_parameter_set_id");
  if (is_high_profile(profile)) read_high_profile_fields(bits);
  sets.log2_max_frame_num =
      static_cast<int>(4 + in_range(bits.get_unsigned(), 0U, 12U, "log2_max_frame_num_minus4"));
  const std::uint32_t order_type = bits.get_unsigned();
  refuse_if(order_type != 2,
            text("picture order type ", order_type, " (as for B-frames and fields)"));
  refuse_if(bits.get_unsigned() == 0, "no reference pictures");
  bits.get_flag();  // gaps_in_frame_num_value_allowed_flag
  const auto side_mb = [&](std::string_view name) {
    constexpr auto kLast = static_cast<std::uint32_t>(kMaxSide_mb - 1);
    return 1 + static_cast<int>(in_range(bits.get_unsigned(), 0U, kLast, name));
  };
  sets.width_mb = side_mb("pic_width_in_mbs_minus1");
  sets.height_mb = side_mb("pic_height_in_map_units_minus1");
  refuse_if(!bits.get_flag(), "fields");
  bits.get_flag();  // direct_8x8_inference_flag
  if (bits.get_flag()) {
    read_cropping(bits, 16U * sets.width_mb, "width");
    read_cropping(bits, 16U * sets.height_mb, "height");
  }
  bits.get_flag();  // vui_parameters_present_flag
  return id;
}

/// pic_parameter_set_rbsp(), 7.3.2.2.
void read_picture(BitReader bits, std::uint32_t sequence_id, ParameterSets& sets) {
  sets.picture_parameter_set_id = in_range(bits.get_unsigned(), 0U, 255U, "pic_parameter_set_id");
  in_range(bits.get_unsigned(), sequence_id, sequence_id, "seq_parameter_set_id");
  refuse_if(bits.get_flag(), "CABAC");
  bits.get_flag();  // bottom_field_pic_order_in_frame_present_flag: of no use to type 2
  refuse_if(bits.get_unsigned() != 0, "slice groups");
  sets.overrides_reference_count =
      in_range(bits.get_unsigned(), 0U, 31U, "num_ref_idx_l0_default_active_minus1") != 0;
  in_range(bits.get_unsigned(), 0U, 31U, "num_ref_idx_l1_default_active_minus1");
  refuse_if(bits.get_flag(), "weighted prediction");
  bits.get(2);  // weighted_bipred_idc: of B slices
  sets.initial_qp = 26 + in_range(bits.get_signed(), -26, 25, "pic_init_qp_minus26");
  in_range(bits.get_signed(), -26, 25, "pic_init_qs_minus26");
  sets.chroma_qp_offset = in_range(bits.get_signed(), -12, 12, "chroma_qp_index_offset");
  refuse_if(!bits.get_flag(), "deblocking that slices cannot switch off");
  refuse_if(bits.get_flag(), "constrained intra prediction");
  refuse_if(bits.get_flag(), "redundant pictures");
  if (bits.has_more_data()) {  // only in high profiles
    refuse_if(bits.get_flag(), "8x8 transforms");
    refuse_if(bits.get_flag(), "scaling matrices");
    refuse_if(bits.get_signed() != sets.chroma_qp_offset, "different quantisers for Cb and Cr");
  }
  if (bits.has_more_data()) throw HeaderError("h264: a picture parameter set has more than it may");
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
  const ParameterSets sets = parameter_sets(config);
  bits.put(kBaseline, 8);
  bits.put(kConstrained, 8);
  bits.put(static_cast<unsigned>(level_idc), 8);
  bits.put_unsigned(0);  // seq_parameter_set_id
  bits.put_unsigned(static_cast<unsigned>(sets.log2_max_frame_num - 4));
  bits.put_unsigned(2);  // pic_order_cnt_type: the order of decoding
  bits.put_unsigned(1);  // max_num_ref_frames
  bits.put_flag(false);  // gaps_in_frame_num_value_allowed_flag
  bits.put_unsigned(static_cast<unsigned>(sets.width_mb - 1));
  bits.put_unsigned(static_cast<unsigned>(sets.height_mb - 1));
  bits.put_flag(true);  // frame_mbs_only_flag
  bits.put_flag(true);  // direct_8x8_inference_flag
  const int right_px = kLumaSide * sets.width_mb - config.width_px;
  const int below_px = kLumaSide * sets.height_mb - config.height_px;
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
  const ParameterSets sets = parameter_sets(config);
  bits.put_unsigned(sets.picture_parameter_set_id);
  bits.put_unsigned(0);  // seq_parameter_set_id
  bits.put_flag(false);  // entropy_coding_mode_flag: CAVLC
  bits.put_flag(false);  // bottom_field_pic_order_in_frame_present_flag
  bits.put_unsigned(0);  // num_slice_groups_minus1
  bits.put_unsigned(0);  // num_ref_idx_l0_default_active_minus1
  bits.put_unsigned(0);  // num_ref_idx_l1_default_active_minus1
  bits.put_flag(false);  // weighted_pred_flag
  bits.put(0, 2);        // weighted_bipred_idc
  bits.put_signed(sets.initial_qp - 26);
  bits.put_signed(0);  // pic_init_qs_minus26
  bits.put_signed(sets.chroma_qp_offset);
  bits.put_flag(true);   // deblocking_filter_control_present_flag
  bits.put_flag(false);  // constrained_intra_pred_flag
  bits.put_flag(false);  // redundant_pic_cnt_present_flag
  bits.put_trailing_bits();
}

}  // namespace

ParameterSets parameter_sets(const Config& config) {
  return {.width_mb = (config.width_px + kLumaSide - 1) / kLumaSide,
          .height_mb = (config.height_px + kLumaSide - 1) / kLumaSide,
          .log2_max_frame_num = 4,
          .picture_parameter_set_id = 0,
          .overrides_reference_count = false,
          .initial_qp = config.qp,
          .chroma_qp_offset = 0};
}

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

ParameterSets read_parameter_sets(std::span<const std::uint8_t> stream) {
  constexpr auto kSequence = static_cast<int>(UnitType::sequence_parameters);
  constexpr auto kPicture = static_cast<int>(UnitType::picture_parameters);
  std::vector<Unit> units = read_units(stream);
  std::erase_if(units, [](const Unit& u) { return u.type != kSequence && u.type != kPicture; });
  if (units.size() != 2 || units[0].type != kSequence || units[1].type != kPicture) {
    throw HeaderError("h264: a stream needs one sequence and then one picture parameter set");
  }
  ParameterSets sets{};
  const std::uint32_t sequence_id = read_sequence(BitReader(units[0].rbsp), sets);
  read_picture(BitReader(units[1].rbsp), sequence_id, sets);
  return sets;
}

}  // namespace piblocks::h264
