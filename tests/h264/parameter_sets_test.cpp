// Which headers of other encoders ours may stand for: those written here field by field and broken
// in every way, and those of libx264.
#include "h264/parameter_sets.hpp"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "h264/bit_stream.hpp"
#include "h264/nal_unit.hpp"
#include "media/libav/av.hpp"
#include "support/traced_random.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks::h264 {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The fields of the parameter sets, 7.3.2.
struct Headers {
  unsigned profile_idc = 66;
  unsigned sps_id = 0;
  unsigned chroma_format_idc = 1;
  unsigned bit_depth_luma_minus8 = 0;
  unsigned bit_depth_chroma_minus8 = 0;
  bool transform_bypass = false;
  bool sps_scaling_matrix = false;
  unsigned log2_max_frame_num_minus4 = 0;
  unsigned pic_order_cnt_type = 2;
  unsigned max_num_ref_frames = 1;
  unsigned pic_width_in_mbs_minus1 = 9;
  unsigned pic_height_in_map_units_minus1 = 4;
  bool frame_mbs_only = true;
  std::vector<unsigned> cropping = {};
  unsigned pps_id = 0;
  unsigned sps_id_of_pps = 0;
  bool entropy_coding_mode = false;
  unsigned num_slice_groups_minus1 = 0;
  unsigned num_ref_idx_l0_minus1 = 0;
  bool weighted_pred = false;
  int pic_init_qp_minus26 = 0;
  int chroma_qp_index_offset = 0;
  bool deblocking_filter_control = true;
  bool constrained_intra_pred = false;
  bool redundant_pic_cnt = false;
  bool has_extension = false;
  bool transform_8x8_mode = false;
  bool pps_scaling_matrix = false;
  int second_chroma_qp_index_offset = 0;
};

BitWriter sequence_of(const Headers& h) {
  BitWriter bits;
  bits.put(h.profile_idc, 8);
  bits.put(0xc01f, 16);  // constraint flags, level 3.1
  bits.put_unsigned(h.sps_id);
  if (h.profile_idc >= 100) {
    bits.put_unsigned(h.chroma_format_idc);
    bits.put_unsigned(h.bit_depth_luma_minus8);
    bits.put_unsigned(h.bit_depth_chroma_minus8);
    bits.put_flag(h.transform_bypass);
    bits.put_flag(h.sps_scaling_matrix);
  }
  bits.put_unsigned(h.log2_max_frame_num_minus4);
  bits.put_unsigned(h.pic_order_cnt_type);
  bits.put_unsigned(h.max_num_ref_frames);
  bits.put_flag(false);
  bits.put_unsigned(h.pic_width_in_mbs_minus1);
  bits.put_unsigned(h.pic_height_in_map_units_minus1);
  bits.put_flag(h.frame_mbs_only);
  bits.put_flag(true);
  bits.put_flag(!h.cropping.empty());
  for (const unsigned offset : h.cropping) bits.put_unsigned(offset);
  bits.put_flag(false);  // no VUI
  bits.put_trailing_bits();
  return bits;
}

BitWriter picture_of(const Headers& h) {
  BitWriter bits;
  bits.put_unsigned(h.pps_id);
  bits.put_unsigned(h.sps_id_of_pps);
  bits.put_flag(h.entropy_coding_mode);
  bits.put_flag(false);
  bits.put_unsigned(h.num_slice_groups_minus1);
  bits.put_unsigned(h.num_ref_idx_l0_minus1);
  bits.put_unsigned(0);
  bits.put_flag(h.weighted_pred);
  bits.put(0, 2);
  bits.put_signed(h.pic_init_qp_minus26);
  bits.put_signed(0);
  bits.put_signed(h.chroma_qp_index_offset);
  bits.put_flag(h.deblocking_filter_control);
  bits.put_flag(h.constrained_intra_pred);
  bits.put_flag(h.redundant_pic_cnt);
  if (h.has_extension) {
    bits.put_flag(h.transform_8x8_mode);
    bits.put_flag(h.pps_scaling_matrix);
    bits.put_signed(h.second_chroma_qp_index_offset);
  }
  bits.put_trailing_bits();
  return bits;
}

Bytes stream_of(const Headers& headers) {
  Bytes stream;
  append_unit(UnitType::sequence_parameters, 3, sequence_of(headers).bytes(), stream);
  append_unit(UnitType::picture_parameters, 3, picture_of(headers).bytes(), stream);
  return stream;
}

/// Of the default headers.
const Config kConfig = {.width_px = 160, .height_px = 80, .qp = 26};

bool is_accepted(const Headers& headers) { return may_follow(stream_of(headers), kConfig); }

TEST(BitReader, ReadsWhatBitWriterWrites) {
  BitWriter bits;
  bits.put(0xdeadbeef, 32);
  bits.put(5, 3);
  const std::vector<std::uint32_t> numbers = {0, 1, 2, 7, 8, 65534, 65535, 0xfffffffe};
  const std::vector<std::int32_t> signed_numbers = {0, 1, -1, 2, -2, 1000, -1000, 1073741823};
  for (const std::uint32_t number : numbers) bits.put_unsigned(number);
  for (const std::int32_t number : signed_numbers) bits.put_signed(number);
  bits.put_trailing_bits();

  BitReader reader(bits.bytes());
  EXPECT_EQ(reader.get(32), 0xdeadbeefU);
  EXPECT_EQ(reader.get(3), 5U);
  for (const std::uint32_t number : numbers) EXPECT_EQ(reader.get_unsigned(), number);
  for (const std::int32_t number : signed_numbers) {
    EXPECT_TRUE(reader.has_more_data());
    EXPECT_EQ(reader.get_signed(), number);
  }
  EXPECT_FALSE(reader.has_more_data());
  EXPECT_THROW(reader.get_flag(), HeaderError);
  EXPECT_EQ(reader.get(0), 0U);
}

TEST(BitReader, RefusesToReadPastTheEnd) {
  const Bytes ones = {0xff, 0, 0};
  EXPECT_THROW(BitReader(ones).get(8), HeaderError);
  const Bytes zeros(20);
  EXPECT_THROW(BitReader(zeros).get_flag(), HeaderError);
  EXPECT_THROW(BitReader(Bytes{}).get_unsigned(), HeaderError);
  const Bytes long_number = {0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0xff};
  EXPECT_THROW(BitReader(long_number).get_unsigned(), HeaderError);
}

TEST(MayFollow, OurOwnHeadersOfEverySize) {
  for (const Config& config :
       {kConfig, Config{.width_px = 2, .height_px = 2}, Config{.width_px = 1920, .height_px = 1080},
        Config{.width_px = 16880, .height_px = 2, .qp = 0}}) {
    EXPECT_TRUE(may_follow(write_parameter_sets(config, 40), config)) << config.width_px;
    Config other = config;
    ++other.qp;
    EXPECT_FALSE(may_follow(write_parameter_sets(config, 40), other)) << config.width_px;
  }
}

TEST(MayFollow, WhatDiffersInNothingThatSlicesDependOn) {
  EXPECT_TRUE(is_accepted({}));
  EXPECT_TRUE(is_accepted({.cropping = {40, 39, 20, 19}}));
  EXPECT_TRUE(is_accepted({.profile_idc = 100, .has_extension = true}));
}

TEST(MayFollow, NothingThatDiffersInOneField) {
  const std::vector<Headers> others = {
      {.profile_idc = 122, .chroma_format_idc = 2},
      {.profile_idc = 110, .bit_depth_luma_minus8 = 2},
      {.profile_idc = 110, .bit_depth_chroma_minus8 = 2},
      {.profile_idc = 244, .transform_bypass = true},
      {.profile_idc = 100, .sps_scaling_matrix = true},
      {.sps_id = 1, .sps_id_of_pps = 1},
      {.log2_max_frame_num_minus4 = 1},
      {.pic_order_cnt_type = 0},
      {.max_num_ref_frames = 0},
      {.max_num_ref_frames = 3},
      {.pic_width_in_mbs_minus1 = 8},
      {.pic_height_in_map_units_minus1 = 0xfffffffe},
      {.frame_mbs_only = false},
      {.pps_id = 1},
      {.sps_id_of_pps = 1},
      {.entropy_coding_mode = true},
      {.num_slice_groups_minus1 = 1},
      {.num_ref_idx_l0_minus1 = 2},
      {.weighted_pred = true},
      {.pic_init_qp_minus26 = 1},
      {.chroma_qp_index_offset = -3},
      {.deblocking_filter_control = false},
      {.constrained_intra_pred = true},
      {.redundant_pic_cnt = true},
      {.has_extension = true, .transform_8x8_mode = true},
      {.has_extension = true, .pps_scaling_matrix = true},
      {.has_extension = true, .second_chroma_qp_index_offset = -1},
  };
  for (const Headers& other : others) EXPECT_FALSE(is_accepted(other)) << &other - others.data();
}

TEST(MayFollow, OnlyOneSetOfEach) {
  Bytes sequence;
  append_unit(UnitType::sequence_parameters, 3, sequence_of({}).bytes(), sequence);
  Bytes picture;
  append_unit(UnitType::picture_parameters, 3, picture_of({}).bytes(), picture);
  const auto is_joined_accepted = [](const std::vector<Bytes>& parts) {
    Bytes stream;
    for (const Bytes& part : parts) stream.insert(stream.end(), part.begin(), part.end());
    return may_follow(stream, kConfig);
  };
  const Bytes information = {0, 0, 1, 6, 5, 1, 9, 0x80};
  EXPECT_TRUE(is_joined_accepted({information, sequence, information, picture}));
  for (const std::vector<Bytes>& parts : std::vector<std::vector<Bytes>>{
           {}, {sequence}, {picture}, {picture, sequence}, {sequence, picture, picture}}) {
    EXPECT_FALSE(is_joined_accepted(parts));
  }
}

TEST(MayFollow, NothingThatIsCutOffOrGoesOn) {
  for (const Headers& headers : {Headers{}, Headers{.profile_idc = 100, .has_extension = true}}) {
    const Bytes stream = stream_of(headers);
    for (std::size_t size = 0; size < stream.size(); ++size) {
      EXPECT_FALSE(may_follow(std::span(stream).first(size), kConfig)) << size;
    }
  }
  Bytes stream = stream_of({});
  stream.insert(stream.end(), {0x55, 0x55});
  EXPECT_FALSE(may_follow(stream, kConfig));
}

/// The sanitizers would say if anything is read that is not there.
TEST(MayFollow, OfAnyBytesIsAnswered) {
  TracedRandom random(66);
  for (int i = 0; i < 20000; ++i) {
    Bytes stream = stream_of({.profile_idc = i % 2 == 0 ? 66U : 100U, .has_extension = i % 3 == 0});
    for (std::int64_t flips = random.integer(1, 4); flips > 0; --flips) {
      const std::int64_t bit = random.integer(0, std::int64_t(8 * stream.size()) - 1);
      stream.at(std::size_t(bit / 8)) ^= static_cast<std::uint8_t>(1 << (bit % 8));
    }
    may_follow(stream, kConfig);
    Bytes rbsp(std::size_t(random.integer(0, 20)));
    for (std::uint8_t& byte : rbsp) byte = random.byte();
    stream.clear();
    append_unit(UnitType::sequence_parameters, 3, rbsp, stream);
    append_unit(UnitType::picture_parameters, 3, rbsp, stream);
    may_follow(stream, kConfig);
  }
}

/// Headers that libx264 writes through libavcodec, with these options.
Bytes x264_headers(const Config& config,
                   const std::vector<std::pair<std::string, std::string>>& options) {
  const AVCodec* const codec = avcodec_find_encoder_by_name("libx264");
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), "libx264");
  context->width = config.width_px;
  context->height = config.height_px;
  context->pix_fmt = AV_PIX_FMT_YUV420P;
  context->time_base = {1, 60};
  context->thread_count = 1;
  context->flags = static_cast<int>(AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT);
  for (const auto& [name, value] : options) {
    const int code = av_opt_set(context.get(), name.c_str(), value.c_str(), AV_OPT_SEARCH_CHILDREN);
    check_av(code, "set", name);
  }
  check_av(avcodec_open2(context.get(), codec, nullptr), "open encoder", "libx264");
  return {context->extradata, context->extradata + context->extradata_size};
}

TEST(MayFollow, SlicesOfX264InItsFastestPresetAtTheSameQp) {
  silence_av();
  if (avcodec_find_encoder_by_name("libx264") == nullptr) GTEST_SKIP() << "there is no libx264";
  for (const auto& [width, height] : {std::pair(1920, 1080), {250, 234}, {2, 2}}) {
    const Config config = {.width_px = width, .height_px = height, .qp = 14};
    EXPECT_TRUE(may_follow(x264_headers(config, {{"preset", "ultrafast"}, {"qp", "14"}}), config));
    EXPECT_FALSE(may_follow(x264_headers(config, {{"preset", "ultrafast"}, {"qp", "15"}}), config));
    for (const char* preset : {"superfast", "veryfast", "medium", "veryslow"}) {
      EXPECT_FALSE(may_follow(x264_headers(config, {{"preset", preset}, {"qp", "14"}}), config));
    }
  }
}

}  // namespace
}  // namespace piblocks::h264
