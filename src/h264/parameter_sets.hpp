// The headers of a stream: the sequence and the picture parameter set.
// In: a config. Out: the headers of our own stream; whether slices of another encoder can stand
// under them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "h264/encoder.hpp"

namespace piblocks::h264 {

/// log2_max_frame_num: the bits of frame_num in every slice.
inline constexpr int kFrameNum_bits = 4;

/// The headers, with start codes, of a stream of this level: Constrained Baseline, BT.709 limited,
/// square pixels, a fixed rate, one reference picture, no reordering (7.3.2.1, 7.3.2.2, E.1.1).
/// Slices depend on what libx264 says in its preset ultrafast, at this quantiser.
std::vector<std::uint8_t> write_parameter_sets(const Config& config, int level_idc);

/// Of the sequence parameter set in a stream's headers; 0 if there is none.
int profile_idc(std::span<const std::uint8_t> headers);

/// Whether slices of an encoder with other headers can follow ours: whether these agree with ours
/// in all that slices depend on (7.4.2.1, 7.4.2.2).
/// @param headers  with start codes; false for any that cannot be read.
bool may_follow(std::span<const std::uint8_t> headers, const Config& config);

}  // namespace piblocks::h264
