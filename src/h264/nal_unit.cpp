#include "h264/nal_unit.hpp"

#include <algorithm>
#include <array>

namespace piblocks::h264 {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 4> kStartCode = {0, 0, 0, 1};
constexpr std::uint8_t kEmulationPrevention = 3;

std::vector<std::uint8_t> without_emulation_prevention(Bytes bytes) {
  std::vector<std::uint8_t> rbsp;
  rbsp.reserve(bytes.size());
  int zeros = 0;
  for (const std::uint8_t byte : bytes) {
    if (zeros < 2 || byte != kEmulationPrevention) rbsp.push_back(byte);
    zeros = byte == 0 ? zeros + 1 : 0;
  }
  return rbsp;
}

/// A fourth zero before the start code is one of those that may follow any unit.
Bytes::iterator next_unit(Bytes stream, Bytes::iterator from) {
  return std::search(from, stream.end(), kStartCode.begin() + 1, kStartCode.end());
}

}  // namespace

void append_unit(UnitType type, int nal_ref_idc, Bytes rbsp, std::vector<std::uint8_t>& stream) {
  stream.insert(stream.end(), kStartCode.begin(), kStartCode.end());
  stream.push_back(static_cast<std::uint8_t>(nal_ref_idc << 5 | static_cast<int>(type)));
  int zeros = 0;
  for (const std::uint8_t byte : rbsp) {
    if (zeros == 2 && byte <= kEmulationPrevention) {
      stream.push_back(kEmulationPrevention);
      zeros = 0;
    }
    stream.push_back(byte);
    zeros = byte == 0 ? zeros + 1 : 0;
  }
  if (zeros > 0) stream.push_back(kEmulationPrevention);
}

std::vector<Unit> read_units(Bytes stream) {
  std::vector<Unit> units;
  for (auto start = next_unit(stream, stream.begin()); start != stream.end();) {
    const auto begin = start + 3;
    start = next_unit(stream, begin);
    auto end = start;
    while (end != begin && end[-1] == 0) --end;
    if (begin == end) continue;
    units.push_back({*begin & 31, without_emulation_prevention(Bytes(begin + 1, end))});
  }
  return units;
}

Bytes without_user_data(Bytes access_unit) {
  constexpr std::uint8_t kUnregisteredUserData = 5;  // payloadType
  const auto first = next_unit(access_unit, access_unit.begin());
  const bool is_user_data = access_unit.end() - first > 4 &&
                            first[3] == static_cast<int>(UnitType::sei) &&
                            first[4] == kUnregisteredUserData;
  if (!is_user_data) return access_unit;
  const auto second = next_unit(access_unit, first + 3);
  return second == access_unit.end() ? access_unit : Bytes(second, access_unit.end());
}

}  // namespace piblocks::h264
