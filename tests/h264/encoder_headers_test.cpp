// The headers of a stream of our own: every field by a reader that is written here from clause
// 7.3.2 and annex E, and what libavcodec makes of them.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "h264/callers_picture.hpp"
#include "h264/encoder.hpp"
#include "h264/parameter_sets.hpp"
#include "media/libav/av.hpp"
#include "media/libav/av_versions.hpp"

namespace piblocks::h264 {
namespace {

using Fields = std::map<std::string, std::int64_t>;

std::vector<Config> configs() {
  constexpr std::int64_t kMost = 2147483647;
  return {
      {.width_px = 2, .height_px = 2},
      {.width_px = 1920, .height_px = 1080},
      {.width_px = 1920, .height_px = 1088, .rate_numerator = 30000, .rate_denominator = 1001},
      {.width_px = 34, .height_px = 64, .rate_numerator = 1, .rate_denominator = 256, .qp = 0},
      {.width_px = 64, .height_px = 46, .rate_numerator = 7, .qp = 41},
      {.width_px = 352, .height_px = 288, .rate_numerator = 30, .qp = 26},
      {.width_px = 16880, .height_px = 2, .rate_numerator = kMost, .rate_denominator = kMost},
      {.width_px = 18, .height_px = 18, .rate_numerator = 1, .rate_denominator = kMost, .qp = 27},
      {.width_px = 8192, .height_px = 4352, .rate_numerator = 120},
  };
}

/// The bits of a NAL unit, without emulation_prevention_three_byte. The fields that are read are
/// kept by their names.
class FieldReader {
 public:
  explicit FieldReader(const std::vector<std::uint8_t>& unit) {
    for (std::size_t i = 1; i < unit.size(); ++i) {
      const bool is_extra = i > 2 && unit[i] == 3 && unit[i - 1] == 0 && unit[i - 2] == 0;
      if (is_extra) continue;
      for (int bit = 7; bit >= 0; --bit) bits_.push_back((unit[i] >> bit & 1) != 0);
    }
  }

  std::int64_t u(int count, const std::string& name) { return fields[name] = number(count); }
  std::int64_t ue(const std::string& name) { return fields[name] = code(); }
  std::int64_t se(const std::string& name) {
    const std::int64_t k = code();
    return fields[name] = k % 2 == 0 ? -k / 2 : (k + 1) / 2;
  }
  /// rbsp_trailing_bits() and nothing more.
  bool is_at_end() {
    if (number(1) != 1) return false;
    while (at_ % 8 != 0) {
      if (number(1) != 0) return false;
    }
    return at_ == bits_.size();
  }

  Fields fields;

 private:
  std::int64_t number(int count) {
    std::int64_t value = 0;
    for (; count > 0; --count) value = 2 * value + (bits_.at(at_++) ? 1 : 0);
    return value;
  }
  std::int64_t code() {
    int zeros = 0;
    while (number(1) == 0) ++zeros;
    return (std::int64_t{1} << zeros) - 1 + number(zeros);
  }

  std::vector<bool> bits_;
  std::size_t at_ = 0;
};

/// The NAL units of a stream whose start codes have four bytes.
std::vector<std::vector<std::uint8_t>> units_of(std::span<const std::uint8_t> stream) {
  std::vector<std::vector<std::uint8_t>> units;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const bool is_start = i + 4 <= stream.size() && stream[i] == 0 && stream[i + 1] == 0 &&
                          stream[i + 2] == 0 && stream[i + 3] == 1;
    if (is_start) {
      units.emplace_back();
      i += 3;
    } else if (!units.empty()) {
      units.back().push_back(stream[i]);
    }
  }
  return units;
}

/// vui_parameters(), E.1.1
void read_usability(FieldReader& bits) {
  if (bits.u(1, "aspect_ratio_info_present_flag") != 0) bits.u(8, "aspect_ratio_idc");
  bits.u(1, "overscan_info_present_flag");
  if (bits.u(1, "video_signal_type_present_flag") != 0) {
    bits.u(3, "video_format");
    bits.u(1, "video_full_range_flag");
    if (bits.u(1, "colour_description_present_flag") != 0) {
      bits.u(8, "colour_primaries");
      bits.u(8, "transfer_characteristics");
      bits.u(8, "matrix_coefficients");
    }
  }
  if (bits.u(1, "chroma_loc_info_present_flag") != 0) {
    bits.ue("chroma_sample_loc_type_top_field");
    bits.ue("chroma_sample_loc_type_bottom_field");
  }
  if (bits.u(1, "timing_info_present_flag") != 0) {
    bits.u(32, "num_units_in_tick");
    bits.u(32, "time_scale");
    bits.u(1, "fixed_frame_rate_flag");
  }
  bits.u(1, "nal_hrd_parameters_present_flag");
  bits.u(1, "vcl_hrd_parameters_present_flag");
  bits.u(1, "pic_struct_present_flag");
  if (bits.u(1, "bitstream_restriction_flag") == 0) return;
  bits.u(1, "motion_vectors_over_pic_boundaries_flag");
  for (const char* name :
       {"max_bytes_per_pic_denom", "max_bits_per_mb_denom", "log2_max_mv_length_horizontal",
        "log2_max_mv_length_vertical", "max_num_reorder_frames", "max_dec_frame_buffering"}) {
    bits.ue(name);
  }
}

/// seq_parameter_set_rbsp() of a profile without the fields of the high ones, 7.3.2.1
Fields sequence_fields(const std::vector<std::uint8_t>& unit) {
  FieldReader bits(unit);
  bits.u(8, "profile_idc");
  for (int i = 0; i < 6; ++i) bits.u(1, "constraint_set" + std::to_string(i) + "_flag");
  bits.u(2, "reserved_zero_2bits");
  bits.u(8, "level_idc");
  bits.ue("seq_parameter_set_id");
  bits.ue("log2_max_frame_num_minus4");
  bits.ue("pic_order_cnt_type");
  bits.ue("max_num_ref_frames");
  bits.u(1, "gaps_in_frame_num_value_allowed_flag");
  bits.ue("pic_width_in_mbs_minus1");
  bits.ue("pic_height_in_map_units_minus1");
  bits.u(1, "frame_mbs_only_flag");
  bits.u(1, "direct_8x8_inference_flag");
  if (bits.u(1, "frame_cropping_flag") != 0) {
    for (const char* side : {"left", "right", "top", "bottom"}) {
      bits.ue(std::string("frame_crop_") + side + "_offset");
    }
  }
  if (bits.u(1, "vui_parameters_present_flag") != 0) read_usability(bits);
  EXPECT_TRUE(bits.is_at_end());
  return bits.fields;
}

/// pic_parameter_set_rbsp(), 7.3.2.2
Fields picture_fields(const std::vector<std::uint8_t>& unit) {
  FieldReader bits(unit);
  bits.ue("pic_parameter_set_id");
  bits.ue("seq_parameter_set_id");
  bits.u(1, "entropy_coding_mode_flag");
  bits.u(1, "bottom_field_pic_order_in_frame_present_flag");
  bits.ue("num_slice_groups_minus1");
  bits.ue("num_ref_idx_l0_default_active_minus1");
  bits.ue("num_ref_idx_l1_default_active_minus1");
  bits.u(1, "weighted_pred_flag");
  bits.u(2, "weighted_bipred_idc");
  bits.se("pic_init_qp_minus26");
  bits.se("pic_init_qs_minus26");
  bits.se("chroma_qp_index_offset");
  bits.u(1, "deblocking_filter_control_present_flag");
  bits.u(1, "constrained_intra_pred_flag");
  bits.u(1, "redundant_pic_cnt_present_flag");
  EXPECT_TRUE(bits.is_at_end());
  return bits.fields;
}

Fields expected_sequence(const Config& config, int level_idc) {
  const int width_mb = (config.width_px + 15) / 16;
  const int height_mb = (config.height_px + 15) / 16;
  Fields fields = {{"profile_idc", 66},
                   {"constraint_set0_flag", 1},
                   {"constraint_set1_flag", 1},
                   {"constraint_set2_flag", 0},
                   {"constraint_set3_flag", 0},
                   {"constraint_set4_flag", 0},
                   {"constraint_set5_flag", 0},
                   {"reserved_zero_2bits", 0},
                   {"level_idc", level_idc},
                   {"seq_parameter_set_id", 0},
                   {"log2_max_frame_num_minus4", 0},
                   {"pic_order_cnt_type", 2},
                   {"max_num_ref_frames", 1},
                   {"gaps_in_frame_num_value_allowed_flag", 0},
                   {"pic_width_in_mbs_minus1", width_mb - 1},
                   {"pic_height_in_map_units_minus1", height_mb - 1},
                   {"frame_mbs_only_flag", 1},
                   {"direct_8x8_inference_flag", 1},
                   {"vui_parameters_present_flag", 1},
                   {"aspect_ratio_info_present_flag", 1},
                   {"aspect_ratio_idc", 1},
                   {"overscan_info_present_flag", 0},
                   {"video_signal_type_present_flag", 1},
                   {"video_format", 5},
                   {"video_full_range_flag", 0},
                   {"colour_description_present_flag", 1},
                   {"colour_primaries", 1},
                   {"transfer_characteristics", 1},
                   {"matrix_coefficients", 1},
                   {"chroma_loc_info_present_flag", 1},
                   {"chroma_sample_loc_type_top_field", 0},
                   {"chroma_sample_loc_type_bottom_field", 0},
                   {"timing_info_present_flag", 1},
                   {"num_units_in_tick", config.rate_denominator},
                   {"time_scale", 2 * config.rate_numerator},
                   {"fixed_frame_rate_flag", 1},
                   {"nal_hrd_parameters_present_flag", 0},
                   {"vcl_hrd_parameters_present_flag", 0},
                   {"pic_struct_present_flag", 0},
                   {"bitstream_restriction_flag", 1},
                   {"motion_vectors_over_pic_boundaries_flag", 1},
                   {"max_bytes_per_pic_denom", 0},
                   {"max_bits_per_mb_denom", 0},
                   {"log2_max_mv_length_horizontal", 13},
                   {"log2_max_mv_length_vertical", 11},
                   {"max_num_reorder_frames", 0},
                   {"max_dec_frame_buffering", 1}};
  const int right_px = 16 * width_mb - config.width_px;
  const int below_px = 16 * height_mb - config.height_px;
  const bool is_cut = right_px + below_px > 0;
  fields["frame_cropping_flag"] = is_cut ? 1 : 0;
  if (is_cut) {
    fields["frame_crop_left_offset"] = 0;
    fields["frame_crop_right_offset"] = right_px / 2;
    fields["frame_crop_top_offset"] = 0;
    fields["frame_crop_bottom_offset"] = below_px / 2;
  }
  return fields;
}

TEST(EncoderHeaders, SayWhatTheConfigSays) {
  for (const Config& config : configs()) {
    SCOPED_TRACE(config.width_px);
    const Encoder encoder(config);
    const auto units = units_of(encoder.headers());
    ASSERT_EQ(units.size(), 2u);
    EXPECT_EQ(units[0][0], 0x67);
    EXPECT_EQ(units[1][0], 0x68);
    EXPECT_EQ(sequence_fields(units[0]), expected_sequence(config, encoder.level_idc()));
    const Fields expected = {{"pic_parameter_set_id", 0},
                             {"seq_parameter_set_id", 0},
                             {"entropy_coding_mode_flag", 0},
                             {"bottom_field_pic_order_in_frame_present_flag", 0},
                             {"num_slice_groups_minus1", 0},
                             {"num_ref_idx_l0_default_active_minus1", 0},
                             {"num_ref_idx_l1_default_active_minus1", 0},
                             {"weighted_pred_flag", 0},
                             {"weighted_bipred_idc", 0},
                             {"pic_init_qp_minus26", config.qp - 26},
                             {"pic_init_qs_minus26", 0},
                             {"chroma_qp_index_offset", 0},
                             {"deblocking_filter_control_present_flag", 1},
                             {"constrained_intra_pred_flag", 0},
                             {"redundant_pic_cnt_present_flag", 0}};
    EXPECT_EQ(picture_fields(units[1]), expected);
  }
}

TEST(EncoderHeaders, AreReadAsTheNumbersThatSlicesAreCodedWith) {
  for (const Config& config : configs()) {
    EXPECT_EQ(read_parameter_sets(Encoder(config).headers()), parameter_sets(config))
        << config.width_px;
    EXPECT_LE(Encoder(config).headers().size(), Encoder::max_unit_bytes(config));
  }
}

TEST(EncoderHeaders, AreUnderstoodByLibavcodec) {
  for (const Config& config : configs()) {
    if (config.width_px > 4000) continue;  // it would take long
    SCOPED_TRACE(config.width_px);
    Encoder encoder(config);
    const CallersPicture picture(config.width_px, config.height_px);
    std::vector<std::uint8_t> unit;
    encoder.encode(picture.planes(), {}, PictureType::idr, unit);
    // In the stream, as in a file .h264.
    unit.insert(unit.begin(), encoder.headers().begin(), encoder.headers().end());
    const auto size = static_cast<int>(unit.size());
    unit.resize(unit.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    const AVCodec* const codec = avcodec_find_decoder(AV_CODEC_ID_H264);
    const auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), "decoder");
    context->err_recognition = AV_EF_EXPLODE | AV_EF_COMPLIANT | AV_EF_AGGRESSIVE;
    check_av(avcodec_open2(context.get(), codec, nullptr), "open", "decoder");
    const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
    const auto frame = own_av<AvFramePtr>(av_frame_alloc(), "frame");
    packet->data = unit.data();
    packet->size = size;
    check_av(avcodec_send_packet(context.get(), packet.get()), "decode", "picture");
    check_av(avcodec_send_packet(context.get(), nullptr), "end", "stream");
    check_av(avcodec_receive_frame(context.get(), frame.get()), "decode", "picture");
    EXPECT_EQ(context->profile, FF_PROFILE_H264_CONSTRAINED_BASELINE);
    EXPECT_EQ(context->level, encoder.level_idc());
    EXPECT_EQ(context->has_b_frames, 0);
    EXPECT_EQ(context->refs, 1);
    const double rate = double(config.rate_numerator) / double(config.rate_denominator);
    // libavcodec rounds to terms of 30 bits.
    EXPECT_NEAR(av_q2d(context->framerate), rate, 1e-9 * (1 + rate));
    EXPECT_EQ(frame->width, config.width_px);
    EXPECT_EQ(frame->height, config.height_px);
    EXPECT_EQ(frame->format, AV_PIX_FMT_YUV420P);
    EXPECT_TRUE(is_key_frame(*frame));
    EXPECT_EQ(frame->sample_aspect_ratio.num, 1);
    EXPECT_EQ(frame->sample_aspect_ratio.den, 1);
    EXPECT_EQ(frame->color_range, AVCOL_RANGE_MPEG);
    EXPECT_EQ(frame->colorspace, AVCOL_SPC_BT709);
    EXPECT_EQ(frame->color_primaries, AVCOL_PRI_BT709);
    EXPECT_EQ(frame->color_trc, AVCOL_TRC_BT709);
    EXPECT_EQ(frame->chroma_location, AVCHROMA_LOC_LEFT);
  }
}

}  // namespace
}  // namespace piblocks::h264
