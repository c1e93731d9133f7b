#include "h264/picture_encoder.hpp"

#include <cassert>

#include "h264/nal_unit.hpp"

namespace piblocks::h264 {
namespace {

// slice_type, table 7-6: all slices of the picture are of this type.
constexpr unsigned kAllP = 5;
constexpr unsigned kAllI = 7;

/// Differs from that of an adjacent IDR picture of libx264 (7.4.3), which counts from 0.
constexpr unsigned kIdrPicId = 1;

}  // namespace

PictureEncoder::PictureEncoder(const ParameterSets& sets, int qp)
    : sets_(sets),
      qp_(qp),
      coder_(qp, sets.chroma_qp_offset),
      decoded_(sets.width_mb, sets.height_mb),
      states_(static_cast<std::size_t>(sets.width_mb) * sets.height_mb) {
  assert(0 <= qp && qp <= kMaxQp);
}

std::vector<std::uint8_t> PictureEncoder::encode_idr(const Picture& source) {
  frame_num_ = 0;
  begin_slice(SliceType::i);
  const int count = sets_.width_mb * sets_.height_mb;
  for (int address = 0; address < count; ++address) add(address, source);
  return finish_slice();
}

std::vector<std::uint8_t> PictureEncoder::encode_p(const Picture& source,
                                                   const MacroblockSet& changed) {
  frame_num_ = (frame_num_ + 1) & ((1U << sets_.log2_max_frame_num) - 1);
  begin_slice(SliceType::p);
  changed.for_each([&](int address) { add(address, source); });
  const int skipped = sets_.width_mb * sets_.height_mb - next_address_;
  if (skipped > 0) bits_.put_unsigned(static_cast<std::uint32_t>(skipped));  // mb_skip_run
  return finish_slice();
}

void PictureEncoder::begin_slice(SliceType type) {
  for (const int address : coded_) states_[address] = {};
  coded_.clear();
  bits_.clear();
  transformed_ = 0;
  next_address_ = 0;
  input_.slice_type = type;
  // slice_header(), 7.3.3
  bits_.put_unsigned(0);  // first_mb_in_slice
  bits_.put_unsigned(type == SliceType::i ? kAllI : kAllP);
  bits_.put_unsigned(sets_.picture_parameter_set_id);
  bits_.put(frame_num_, sets_.log2_max_frame_num);
  if (type == SliceType::i) {
    bits_.put_unsigned(kIdrPicId);
    // dec_ref_pic_marking(), 7.3.3.3
    bits_.put_flag(false);  // no_output_of_prior_pics_flag
    bits_.put_flag(false);  // long_term_reference_flag
  } else {
    bits_.put_flag(sets_.overrides_reference_count);
    if (sets_.overrides_reference_count) bits_.put_unsigned(0);  // num_ref_idx_l0_active_minus1
    bits_.put_flag(false);  // ref_pic_list_modification_flag_l0
    bits_.put_flag(false);  // adaptive_ref_pic_marking_mode_flag
  }
  bits_.put_signed(qp_ - sets_.initial_qp);
  bits_.put_unsigned(1);  // disable_deblocking_filter_idc
}

void PictureEncoder::add(int address, const Picture& source) {
  const int x = address % sets_.width_mb;
  const int y = address / sets_.width_mb;
  source.load(x, y, input_.source);
  if (input_.slice_type == SliceType::p) decoded_.load(x, y, input_.before);
  decoded_.load_borders(x, y, input_.borders);
  input_.neighbours = {y > 0 ? &states_[address - sets_.width_mb] : nullptr,
                       x > 0 ? &states_[address - 1] : nullptr};
  const CodedMacroblock coded = coder_.code(input_);
  if (coded.type == MbType::p_skip) return;
  if (coded.type != MbType::i_16x16) ++transformed_;

  // mb_skip_run, 7.3.4.
  if (input_.slice_type == SliceType::p) {
    bits_.put_unsigned(static_cast<std::uint32_t>(address - next_address_));
  }
  if (coded.type == MbType::i_pcm) {
    write_i_pcm(input_.slice_type, coded.samples, bits_);
  } else {
    bits_.append(coded.bits);
  }
  decoded_.store(x, y, coded.samples);
  states_[address] = coded.state;
  coded_.push_back(address);
  next_address_ = address + 1;
}

std::vector<std::uint8_t> PictureEncoder::finish_slice() {
  bits_.put_trailing_bits();
  std::vector<std::uint8_t> stream;
  const bool is_idr = input_.slice_type == SliceType::i;
  append_unit(is_idr ? UnitType::idr_slice : UnitType::slice, is_idr ? 3 : 2, bits_.bytes(),
              stream);
  return stream;
}

}  // namespace piblocks::h264
