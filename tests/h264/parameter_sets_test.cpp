// Parameter sets, written here field by field and broken in every way.
#include "h264/parameter_sets.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "h264/bit_stream.hpp"
#include "h264/nal_unit.hpp"
#include "h264/refused_stream.hpp"
#include "support/property.hpp"

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

using h264::problem_of;
std::string problem_of(const Headers& headers) { return problem_of(stream_of(headers)); }

void expect_refused(const Headers& headers, const std::string& property) {
  EXPECT_EQ(problem_of(headers), "h264: cannot continue a stream with " + property);
}

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

TEST(ParameterSets, AreRead) {
  const ParameterSets sets = read_parameter_sets(stream_of({.sps_id = 31,
                                                            .log2_max_frame_num_minus4 = 12,
                                                            .pic_width_in_mbs_minus1 = 119,
                                                            .pic_height_in_map_units_minus1 = 67,
                                                            .cropping = {0, 0, 0, 4},
                                                            .pps_id = 255,
                                                            .sps_id_of_pps = 31,
                                                            .num_ref_idx_l0_minus1 = 2,
                                                            .pic_init_qp_minus26 = -26,
                                                            .chroma_qp_index_offset = -12}));
  EXPECT_EQ(sets.width_mb, 120);
  EXPECT_EQ(sets.height_mb, 68);
  EXPECT_EQ(sets.log2_max_frame_num, 16);
  EXPECT_EQ(sets.picture_parameter_set_id, 255u);
  EXPECT_TRUE(sets.overrides_reference_count);
  EXPECT_EQ(sets.initial_qp, 0);
  EXPECT_EQ(sets.chroma_qp_offset, -12);
}

TEST(ParameterSets, OfHighProfilesAreReadIfTheyUseNothingOfIt) {
  const ParameterSets sets = read_parameter_sets(stream_of({.profile_idc = 100,
                                                            .pic_init_qp_minus26 = 25,
                                                            .chroma_qp_index_offset = 3,
                                                            .has_extension = true,
                                                            .second_chroma_qp_index_offset = 3}));
  EXPECT_EQ(sets.width_mb, 10);
  EXPECT_EQ(sets.height_mb, 5);
  EXPECT_EQ(sets.log2_max_frame_num, 4);
  EXPECT_EQ(sets.picture_parameter_set_id, 0u);
  EXPECT_FALSE(sets.overrides_reference_count);
  EXPECT_EQ(sets.initial_qp, 51);
  EXPECT_EQ(sets.chroma_qp_offset, 3);
}

TEST(ParameterSets, OfOtherSequencesAreRefusedByName) {
  expect_refused({.profile_idc = 122, .chroma_format_idc = 2}, "chroma other than 4:2:0");
  expect_refused({.profile_idc = 100, .chroma_format_idc = 0}, "chroma other than 4:2:0");
  expect_refused({.profile_idc = 110, .bit_depth_luma_minus8 = 2}, "samples of more than 8 bits");
  expect_refused({.profile_idc = 110, .bit_depth_chroma_minus8 = 2}, "samples of more than 8 bits");
  expect_refused({.profile_idc = 244, .transform_bypass = true}, "lossless macroblocks");
  expect_refused({.profile_idc = 100, .sps_scaling_matrix = true}, "scaling matrices");
  expect_refused({.pic_order_cnt_type = 0}, "picture order type 0 (as for B-frames and fields)");
  expect_refused({.pic_order_cnt_type = 1}, "picture order type 1 (as for B-frames and fields)");
  expect_refused({.max_num_ref_frames = 0}, "no reference pictures");
  expect_refused({.frame_mbs_only = false}, "fields");
}

TEST(ParameterSets, OfOtherPicturesAreRefusedByName) {
  expect_refused({.entropy_coding_mode = true}, "CABAC");
  expect_refused({.num_slice_groups_minus1 = 1}, "slice groups");
  expect_refused({.weighted_pred = true}, "weighted prediction");
  expect_refused({.deblocking_filter_control = false}, "deblocking that slices cannot switch off");
  expect_refused({.constrained_intra_pred = true}, "constrained intra prediction");
  expect_refused({.redundant_pic_cnt = true}, "redundant pictures");
  expect_refused({.has_extension = true, .transform_8x8_mode = true}, "8x8 transforms");
  expect_refused({.has_extension = true, .pps_scaling_matrix = true}, "scaling matrices");
  expect_refused({.has_extension = true, .second_chroma_qp_index_offset = -1},
                 "different quantisers for Cb and Cr");
}

TEST(ParameterSets, OutOfRangeAreRefused) {
  EXPECT_EQ(problem_of(Headers{.log2_max_frame_num_minus4 = 13}),
            "h264: log2_max_frame_num_minus4 of a header is 13, not in [0, 12]");
  EXPECT_EQ(problem_of(Headers{.pic_width_in_mbs_minus1 = 1055}),
            "h264: pic_width_in_mbs_minus1 of a header is 1055, not in [0, 1054]");
  EXPECT_EQ(problem_of(Headers{.pic_height_in_map_units_minus1 = 0xfffffffe}),
            "h264: pic_height_in_map_units_minus1 of a header is 4294967294, not in [0, 1054]");
  EXPECT_EQ(problem_of(Headers{.sps_id_of_pps = 1}),
            "h264: seq_parameter_set_id of a header is 1, not in [0, 0]");
  EXPECT_EQ(problem_of(Headers{.pic_init_qp_minus26 = 26}),
            "h264: pic_init_qp_minus26 of a header is 26, not in [-26, 25]");
  EXPECT_EQ(problem_of(Headers{.chroma_qp_index_offset = -13}),
            "h264: chroma_qp_index_offset of a header is -13, not in [-12, 12]");
  EXPECT_EQ(problem_of(Headers{.cropping = {40, 39, 20, 19}}), "accepted");
  EXPECT_EQ(problem_of(Headers{.cropping = {40, 40, 0, 0}}),
            "h264: nothing is left of a picture's width 160");
  EXPECT_EQ(problem_of(Headers{.cropping = {0, 0, 0xfffffffe, 0xfffffffe}}),
            "h264: nothing is left of a picture's height 80");
}

TEST(ParameterSets, AreOneOfEach) {
  const std::string problem =
      "h264: a stream needs one sequence and then one picture parameter set";
  Bytes sequence;
  append_unit(UnitType::sequence_parameters, 3, sequence_of({}).bytes(), sequence);
  Bytes picture;
  append_unit(UnitType::picture_parameters, 3, picture_of({}).bytes(), picture);
  const auto joined = [](const std::vector<Bytes>& parts) {
    Bytes stream;
    for (const Bytes& part : parts) stream.insert(stream.end(), part.begin(), part.end());
    return stream;
  };
  EXPECT_EQ(problem_of(Bytes{}), problem);
  EXPECT_EQ(problem_of(sequence), problem);
  EXPECT_EQ(problem_of(picture), problem);
  EXPECT_EQ(problem_of(joined({picture, sequence})), problem);
  EXPECT_EQ(problem_of(joined({sequence, picture, picture})), problem);
  EXPECT_EQ(problem_of(joined({sequence, sequence, picture})), problem);
  const Bytes information = {0, 0, 1, 6, 5, 1, 9, 0x80};
  EXPECT_EQ(problem_of(joined({information, sequence, information, picture})), "accepted");
}

TEST(ParameterSets, EndingTooEarlyAreRefused) {
  for (const Headers& headers : {Headers{}, Headers{.profile_idc = 100, .has_extension = true}}) {
    const Bytes stream = stream_of(headers);
    for (std::size_t size = 0; size < stream.size(); ++size) {
      const Bytes start(stream.begin(), stream.begin() + std::ptrdiff_t(size));
      EXPECT_NE(problem_of(start), "accepted") << size;
    }
  }
  Bytes stream = stream_of({});
  stream.insert(stream.end(), {0x55, 0x55});
  EXPECT_NE(problem_of(stream), "accepted");
}

bool is_plausible(const ParameterSets& sets) {
  return sets.width_mb >= 1 && sets.width_mb <= 1055 && sets.height_mb >= 1 &&
         sets.height_mb <= 1055 && sets.log2_max_frame_num >= 4 && sets.log2_max_frame_num <= 16 &&
         sets.picture_parameter_set_id <= 255 && sets.initial_qp >= 0 && sets.initial_qp <= 51 &&
         std::abs(sets.chroma_qp_offset) <= 12;
}

/// The stream with some bits changed, or shortened.
Bytes damaged(Bytes stream, Random& random) {
  for (std::int64_t flips = random.integer(1, 4); flips > 0; --flips) {
    const std::int64_t bit = random.integer(0, std::int64_t(8 * stream.size()) - 1);
    stream.at(std::size_t(bit / 8)) ^= static_cast<std::uint8_t>(1 << (bit % 8));
  }
  if (random.integer(0, 3) == 0) {
    stream.resize(std::size_t(random.integer(0, std::int64_t(stream.size()))));
  }
  return stream;
}

/// Units of the right types with random bytes.
Bytes random_stream(Random& random) {
  Bytes stream;
  for (const UnitType type : {UnitType::sequence_parameters, UnitType::picture_parameters}) {
    Bytes rbsp(std::size_t(random.integer(0, 20)));
    for (std::uint8_t& byte : rbsp) byte = static_cast<std::uint8_t>(random.integer(0, 255));
    append_unit(type, 3, rbsp, stream);
  }
  return stream;
}

/// Any bytes give values within range or a HeaderError.
TEST(ParameterSets, OfAnyBytesAreReadOrRefused) {
  Random random(66);
  SCOPED_TRACE(random.trace());
  const std::vector<Bytes> streams = {stream_of({}),
                                      stream_of({.profile_idc = 100, .has_extension = true})};
  int accepted = 0;
  for (int i = 0; i < 50000 && !HasFailure(); ++i) {
    const std::int64_t kind = random.integer(0, 2);
    const Bytes stream =
        kind == 2 ? random_stream(random) : damaged(streams.at(std::size_t(kind)), random);
    try {
      EXPECT_TRUE(is_plausible(read_parameter_sets(stream)));
      ++accepted;
    } catch (const HeaderError&) {
    }
  }
  EXPECT_GT(accepted, 100);
}

}  // namespace
}  // namespace piblocks::h264
