// Transform coefficients in variable-length codes.
// In: quantised levels of a block in scan order. Out: residual_block_cavlc() of ITU-T H.264,
// 7.3.5.3.2.
#pragma once

#include <cstdint>
#include <span>

#include "h264/bit_writer.hpp"

namespace piblocks::h264 {

/// In place of nC for the DC levels of a chroma plane (9.2.1).
inline constexpr int kChromaDc = -1;

/// @param levels  4 of chroma DC, 15 of AC, or 16.
/// @param total  TotalCoeff: how many of them are not zero.
/// @param nc  nC, from 0 to 16, or kChromaDc.
/// @return false if a level is too large for the profiles without long escapes (9.2.2.1); what has
///         been written is then of no use.
bool write_levels(std::span<const std::int16_t> levels, int total, int nc, BitWriter& bits);

}  // namespace piblocks::h264
