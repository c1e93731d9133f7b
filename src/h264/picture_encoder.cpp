#include "h264/picture_encoder.hpp"

#include <algorithm>
#include <cassert>

#include "h264/nal_unit.hpp"
#include "h264/parameter_sets.hpp"

namespace piblocks::h264 {
namespace {

// slice_type, table 7-6: all slices of the picture are of this type.
constexpr unsigned kAllP = 5;
constexpr unsigned kAllI = 7;

}  // namespace

PictureEncoder::PictureEncoder(const Config& config)
    : width_px_(config.width_px),
      height_px_(config.height_px),
      width_mb_(macroblocks_along(config.width_px)),
      height_mb_(macroblocks_along(config.height_px)),
      coder_(config.qp),
      motion_(config.qp),
      source_(width_mb_, height_mb_),
      before_(width_mb_, height_mb_),
      decoded_(width_mb_, height_mb_),
      taken_(width_mb_, height_mb_),
      changed_(width_mb_, height_mb_),
      visited_(width_mb_, height_mb_),
      states_(static_cast<std::size_t>(width_mb_) * height_mb_),
      last_idr_(width_mb_, height_mb_),
      starts_(states_.size() + 1),
      has_new_result_(states_.size()) {
  last_idr_.starts = starts_;
  assert(0 <= config.qp && config.qp <= kMaxQp);
}

void PictureEncoder::take(const Planes& part, Rect rect) {
  rect.width_px = std::min(rect.width_px, width_px_ - rect.x_px);
  rect.height_px = std::min(rect.height_px, height_px_ - rect.y_px);
  if (rect.width_px <= 0 || rect.height_px <= 0) return;
  const int last_x = (rect.x_px + rect.width_px - 1) / kLumaSide;
  const int last_y = (rect.y_px + rect.height_px - 1) / kLumaSide;
  for (int y_mb = rect.y_px / kLumaSide; y_mb <= last_y; ++y_mb) {
    for (int x_mb = rect.x_px / kLumaSide; x_mb <= last_x; ++x_mb) {
      if (!source_.update(x_mb, y_mb, part, rect)) continue;
      if (kLumaSide * (x_mb + 1) > width_px_ || kLumaSide * (y_mb + 1) > height_px_) {
        source_.extend(x_mb, y_mb, width_px_, height_px_);
      }
      const int address = y_mb * width_mb_ + x_mb;
      taken_.add_one(address);
      last_idr_.changed.add_one(address);
    }
  }
}

void PictureEncoder::encode_idr(Bytes& unit) {
  begin_picture();
  // Those of adjacent IDR pictures differ (7.4.3), also from libx264's, which counts from 0.
  idr_pic_id_ = is_after_idr_ ? 3 - idr_pic_id_ : 1;
  is_after_idr_ = true;
  frame_num_ = 0;
  motion_.begin_group();
  begin_slice(SliceType::i);
  encode_all();
  starts_.back() = bits_.bit_count();
  finish_slice(unit);
  last_idr_.is_valid = !has_i_pcm_;
  last_idr_.changed.clear();
  last_idr_.states = states_;
  std::swap(last_idr_.slice, bits_);
  std::swap(last_idr_.starts, starts_);
  transformed_ = 0;
}

void PictureEncoder::encode_p(Bytes& unit) {
  begin_picture();
  is_after_idr_ = false;
  frame_num_ = (frame_num_ + 1) & ((1U << kFrameNum_bits) - 1);
  motion_.begin_picture(changed_.count());
  begin_slice(SliceType::p);
  visited_ = changed_;
  for (int address = visited_.next(0); address >= 0; address = visited_.next(address + 1)) {
    if (changed_.contains(address)) {
      add(address);
    } else {
      keep(address);
    }
  }
  const int skipped = width_mb_ * height_mb_ - next_address_;
  if (skipped > 0) bits_.put_unsigned(static_cast<std::uint32_t>(skipped));  // mb_skip_run
  finish_slice(unit);
}

void PictureEncoder::begin_picture() {
  const int width = width_mb_;
  for (const int address : coded_) before_.copy(address % width, address / width, decoded_);
  std::swap(changed_, taken_);
  taken_.clear();
}

void PictureEncoder::encode_all() {
  const int count = width_mb_ * height_mb_;
  if (last_idr_.is_valid) states_ = last_idr_.states;
  int done = 0;
  for (int address = 0; address < count; ++address) {
    if (!needs_coding(address)) {
      has_new_result_[address] = 0;
      continue;
    }
    repeat(done, address);
    starts_[address] = bits_.bit_count();
    add(address);
    done = address + 1;
  }
  repeat(done, count);
}

bool PictureEncoder::needs_coding(int address) const {
  return !last_idr_.is_valid || last_idr_.changed.contains(address) ||
         (address % width_mb_ > 0 && has_new_result_[address - 1] != 0) ||
         (address >= width_mb_ && has_new_result_[address - width_mb_] != 0);
}

void PictureEncoder::repeat(int begin, int end) {
  if (begin == end) return;
  const std::vector<std::size_t>& starts = last_idr_.starts;
  const std::size_t to = bits_.bit_count();
  for (int address = begin; address < end; ++address) {
    starts_[address] = to + (starts[address] - starts[begin]);
  }
  bits_.append(last_idr_.slice.bytes(), starts[begin], starts[end]);
}

void PictureEncoder::begin_slice(SliceType type) {
  if (input_.slice_type == SliceType::i) {
    std::ranges::fill(states_, MacroblockState{});
  } else {
    for (const int address : coded_) states_[address] = {};
  }
  coded_.clear();
  has_i_pcm_ = false;
  bits_.clear();
  transformed_ = 0;
  next_address_ = 0;
  input_.slice_type = type;
  // slice_header(), 7.3.3
  bits_.put_unsigned(0);  // first_mb_in_slice
  bits_.put_unsigned(type == SliceType::i ? kAllI : kAllP);
  bits_.put_unsigned(0);  // pic_parameter_set_id
  bits_.put(frame_num_, kFrameNum_bits);
  if (type == SliceType::i) {
    bits_.put_unsigned(idr_pic_id_);
    // dec_ref_pic_marking(), 7.3.3.3
    bits_.put_flag(false);  // no_output_of_prior_pics_flag
    bits_.put_flag(false);  // long_term_reference_flag
  } else {
    bits_.put_flag(false);  // num_ref_idx_active_override_flag
    bits_.put_flag(false);  // ref_pic_list_modification_flag_l0
    bits_.put_flag(false);  // adaptive_ref_pic_marking_mode_flag
  }
  bits_.put_signed(0);    // slice_qp_delta
  bits_.put_unsigned(1);  // disable_deblocking_filter_idc
}

MotionVector PictureEncoder::enter(int address) {
  const int width = width_mb_;
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

void PictureEncoder::add(int address) {
  const int x = address % width_mb_;
  const int y = address / width_mb_;
  const MotionVector vector = enter(address);
  source_.load(x, y, input_.source);
  decoded_.load_borders(x, y, input_.borders);
  if (input_.slice_type == SliceType::p) {
    input_.reference = {&before_, &motion_, x, y};
    predict_moved(before_, x, y, vector, input_.before);
  }
  const CodedMacroblock coded = coder_.code(input_);
  if (input_.slice_type == SliceType::i)
    has_new_result_[address] = has_new_result(address, coded) ? 1 : 0;
  put(address, coded);
}

bool PictureEncoder::has_new_result(int address, const CodedMacroblock& coded) {
  if (!last_idr_.is_valid || last_idr_.changed.contains(address)) return true;
  // What has not changed since then has the decoded samples that it had then.
  decoded_.load(address % width_mb_, address / width_mb_, input_.before);
  return coded.samples.values != input_.before.values || coded.state != last_idr_.states[address];
}

void PictureEncoder::keep(int address) {
  const MotionVector vector = enter(address);
  if (vector == MotionVector{}) return;
  const int x = address % width_mb_;
  const int y = address / width_mb_;
  before_.load(x, y, input_.before);
  put(address, MacroblockCoder::hold(input_.before, input_.neighbours));
}

void PictureEncoder::put(int address, const CodedMacroblock& coded) {
  const bool is_moved = coded.state.vector != MotionVector{};
  if (coded.type == MbType::p_skip && !is_moved) return;
  const int x = address % width_mb_;
  const int y = address / width_mb_;
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
    has_i_pcm_ = true;
    write_i_pcm(input_.slice_type, coded.samples, bits_);
  } else {
    bits_.append(coded.bits);
  }
  next_address_ = address + 1;
}

void PictureEncoder::finish_slice(Bytes& unit) {
  bits_.put_trailing_bits();
  const bool is_idr = input_.slice_type == SliceType::i;
  unit.clear();
  append_unit(is_idr ? UnitType::idr_slice : UnitType::slice, is_idr ? 3 : 2, bits_.bytes(), unit);
}

}  // namespace piblocks::h264
