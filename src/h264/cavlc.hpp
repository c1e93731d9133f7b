// Transform coefficient levels in variable-length codes.
// In: the levels of a block in scan order. Out: residual_block_cavlc() of ITU-T H.264, 7.3.5.3.2.
#pragma once

#include <cstdint>
#include <span>

#include "h264/bit_stream.hpp"

namespace piblocks::h264 {

/// The nC of the DC levels of a chroma plane (9.2.1).
inline constexpr int kChromaDc = -1;

/// @param levels  4 of chroma DC, 15 of AC, or 16.
/// @param total  TotalCoeff: how many of them are not zero.
/// @param nc  nC, from 0 to 16, or kChromaDc.
/// @return false if a level needs a long escape (9.2.2.1), which the profile lacks. The bits are
///         then incomplete.
bool write_levels(std::span<const std::int16_t> levels, int total, int nc, BitWriter& bits);

}  // namespace piblocks::h264
