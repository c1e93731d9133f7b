// NAL units in a byte stream (ITU-T H.264, 7.3.1 and annex B).
// In: an RBSP. Out: a NAL unit with a start code, and back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace piblocks::h264 {

/// nal_unit_type, table 7-1.
enum class UnitType : std::uint8_t {
  slice = 1,
  idr_slice = 5,
  sei = 6,
  sequence_parameters = 7,
  picture_parameters = 8,
  access_unit_delimiter = 9
};

/// Appends a start code of four bytes, the header, and the RBSP with
/// emulation_prevention_three_byte (7.4.1).
/// @param nal_ref_idc  from 0 to 3.
/// @param rbsp  with its trailing bits, after which only cabac_zero_words may follow.
void append_unit(UnitType type, int nal_ref_idc, std::span<const std::uint8_t> rbsp,
                 std::vector<std::uint8_t>& stream);

/// Takes the first NAL unit off the front of a stream with start codes of three or four bytes.
/// @return its bytes, without its start code and zeros after it; empty if there is none.
std::span<const std::uint8_t> take_unit(std::span<const std::uint8_t>& stream);

struct Unit {
  int type;
  std::vector<std::uint8_t> rbsp;
};

/// The units of a stream with start codes of three or four bytes.
std::vector<Unit> read_units(std::span<const std::uint8_t> stream);

/// The access unit without an SEI of user data (D.1.6) at its start, if other units follow.
std::span<const std::uint8_t> without_user_data(std::span<const std::uint8_t> access_unit);

}  // namespace piblocks::h264
