#include "h264/parameter_sets.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

#include "h264/bit_stream.hpp"
#include "h264/nal_unit.hpp"

namespace piblocks::h264 {
namespace {

/// Texts and numbers, one after another.
template <typename... Parts>
std::string message(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

void refuse_if(bool is_other, std::string_view property) {
  if (is_other) throw HeaderError(message("h264: cannot continue a stream with ", property));
}

template <typename Number>
Number in_range(Number value, Number least, Number most, std::string_view name) {
  if (least <= value && value <= most) return value;
  throw HeaderError(
      message("h264: ", name, " of a header is ", value, ", not in [", least, ", ", most, "]"));
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
    throw HeaderError(message("h264: nothing is left of a picture's ", name, " ", size));
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
            message("picture order type ", order_type, " (as for B-frames and fields)"));
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

}  // namespace

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

std::string level_problem(int width_px, int height_px, std::int64_t rate_numerator,
                          std::int64_t rate_denominator) {
  constexpr std::int64_t kMaxRate_mb = 16'711'680;  // MaxMBPS, a second
  const std::int64_t width_mb = (std::int64_t{width_px} + 15) / 16;
  const std::int64_t height_mb = (std::int64_t{height_px} + 15) / 16;
  const std::int64_t size_mb = width_mb * height_mb;
  if (std::max(width_mb, height_mb) > kMaxSide_mb) {
    return message("a side of ", std::max(width_px, height_px), " px is longer than the ",
                   16 * kMaxSide_mb, " px of level 6.2, the highest");
  }
  if (size_mb > kMaxPicture_mb) {
    return message(width_px, "x", height_px, " are ", size_mb,
                   " macroblocks of 16x16 pixels, more than the ", kMaxPicture_mb,
                   " of level 6.2, the highest");
  }
  if (size_mb * rate_numerator > kMaxRate_mb * rate_denominator) {
    const std::string divisor = rate_denominator == 1 ? "" : message("/", rate_denominator);
    return message(size_mb, " macroblocks of 16x16 pixels in each of ", rate_numerator, divisor,
                   " frames a second are more than the ", kMaxRate_mb,
                   " a second of level 6.2, the highest");
  }
  return {};
}

}  // namespace piblocks::h264
