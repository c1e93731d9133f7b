#include "h264/nal_unit.hpp"

#include <algorithm>
#include <array>
#include <cstring>

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
  // The C library looks for the one of a start code much faster than a loop for the whole.
  while (stream.end() - from > 2) {
    const void* const one =
        std::memchr(&from[2], 1, static_cast<std::size_t>(stream.end() - from - 2));
    if (one == nullptr) break;
    from += static_cast<const std::uint8_t*>(one) - &from[2];
    if (from[0] == 0 && from[1] == 0) return from;
    ++from;
  }
  return stream.end();
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

Bytes take_unit(Bytes& stream) {
  for (auto start = next_unit(stream, stream.begin()); start != stream.end();) {
    const auto begin = start + 3;
    start = next_unit(stream, begin);
    auto end = start;
    while (end != begin && end[-1] == 0) --end;
    if (begin == end) continue;
    stream = {start, stream.end()};
    return {begin, end};
  }
  stream = {};
  return {};
}

std::vector<Unit> read_units(Bytes stream) {
  std::vector<Unit> units;
  for (Bytes unit = take_unit(stream); !unit.empty(); unit = take_unit(stream)) {
    units.push_back({unit[0] & 31, without_emulation_prevention(unit.subspan(1))});
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
