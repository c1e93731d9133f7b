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
      source_before_(sets.width_mb, sets.height_mb),
      before_(sets.width_mb, sets.height_mb),
      decoded_(sets.width_mb, sets.height_mb),
      visited_(sets.width_mb, sets.height_mb),
      states_(static_cast<std::size_t>(sets.width_mb) * sets.height_mb) {
  assert(0 <= qp && qp <= kMaxQp);
}

std::vector<std::uint8_t> PictureEncoder::encode_idr(const Picture& source) {
  frame_num_ = 0;
  motion_.begin_group();
  begin_slice(SliceType::i);
  const int count = sets_.width_mb * sets_.height_mb;
  for (int address = 0; address < count; ++address) add(address, source);
  source_before_ = source;
  return finish_slice();
}

std::vector<std::uint8_t> PictureEncoder::encode_p(const Picture& source,
                                                   const MacroblockSet& changed) {
  frame_num_ = (frame_num_ + 1) & ((1U << sets_.log2_max_frame_num) - 1);
  begin_slice(SliceType::p);
  motion_.begin_picture();
  visited_ = changed;
  for (int address = visited_.next(0); address >= 0; address = visited_.next(address + 1)) {
    changed.contains(address) && is_new(address, source) ? add(address, source) : keep(address);
  }
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

bool PictureEncoder::is_new(int address, const Picture& source) {
  const int x = address % sets_.width_mb;
  const int y = address / sets_.width_mb;
  if (source.has_equal(x, y, source_before_)) return false;
  source_before_.copy(x, y, source);
  return true;
}

MotionVector PictureEncoder::enter(int address) {
  const int width = sets_.width_mb;
  const int x = address % width;
  const int y = address / width;
  const auto state = [&](bool is_available, int distance) {
    return is_available ? &states_[static_cast<std::size_t>(address - distance)] : nullptr;
  };
  const bool has_above_right = y > 0 && x + 1 < width;
  input_.neighbours = {state(y > 0, width), state(x > 0, 1),
                       has_above_right ? state(true, width - 1) : state(y > 0 && x > 0, width + 1)};
  return skip_vector(input_.neighbours);
}

void PictureEncoder::add(int address, const Picture& source) {
  const int x = address % sets_.width_mb;
  const int y = address / sets_.width_mb;
  const MotionVector vector = enter(address);
  source.load(x, y, input_.source);
  decoded_.load_borders(x, y, input_.borders);
  if (input_.slice_type == SliceType::p) {
    input_.reference = {&before_, &motion_, x, y};
    predict_moved(before_, x, y, vector, input_.before);
  }
  put(address, coder_.code(input_));
}

void PictureEncoder::keep(int address) {
  const MotionVector vector = enter(address);
  if (vector == MotionVector{}) return;
  const int x = address % sets_.width_mb;
  const int y = address / sets_.width_mb;
  before_.load(x, y, input_.before);
  put(address, coder_.hold(input_.before, input_.neighbours));
}

void PictureEncoder::put(int address, const CodedMacroblock& coded) {
  const bool is_moved = coded.state.vector != MotionVector{};
  if (coded.type == MbType::p_skip && !is_moved) return;
  const int x = address % sets_.width_mb;
  const int y = address / sets_.width_mb;
  decoded_.store(x, y, coded.samples);
  states_[address] = coded.state;
  coded_.push_back(address);
  if (is_moved) {
    // Their vectors as P_Skip follow from this one.
    visited_.add_one(x + 1, y);
    for (const int beside : {x - 1, x, x + 1}) visited_.add_one(beside, y + 1);
  }
  if (coded.type == MbType::p_skip) return;
  if (coded.has_residual || coded.type == MbType::i_pcm) ++transformed_;

  // mb_skip_run, 7.3.4.
  if (input_.slice_type == SliceType::p) {
    bits_.put_unsigned(static_cast<std::uint32_t>(address - next_address_));
  }
  if (coded.type == MbType::i_pcm) {
    write_i_pcm(input_.slice_type, coded.samples, bits_);
  } else {
    bits_.append(coded.bits);
  }
  next_address_ = address + 1;
}

std::vector<std::uint8_t> PictureEncoder::finish_slice() {
  if (input_.slice_type == SliceType::i) {
    before_ = decoded_;
  } else {
    for (const int address : coded_) {
      before_.copy(address % sets_.width_mb, address / sets_.width_mb, decoded_);
    }
  }
  bits_.put_trailing_bits();
  std::vector<std::uint8_t> stream;
  const bool is_idr = input_.slice_type == SliceType::i;
  append_unit(is_idr ? UnitType::idr_slice : UnitType::slice, is_idr ? 3 : 2, bits_.bytes(),
              stream);
  return stream;
}

}  // namespace piblocks::h264
