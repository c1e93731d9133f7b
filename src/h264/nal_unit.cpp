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
    const bool is_inserted = zeros >= 2 && byte == kEmulationPrevention;
    if (!is_inserted) rbsp.push_back(byte);
    zeros = byte == 0 ? zeros + 1 : 0;
  }
  return rbsp;
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
  // A fourth zero before the start code is one of those that may follow any unit.
  const Bytes start_code = Bytes(kStartCode).last(3);
  const auto next_unit = [&](Bytes::iterator from) {
    return std::search(from, stream.end(), start_code.begin(), start_code.end());
  };
  std::vector<Unit> units;
  for (auto start = next_unit(stream.begin()); start != stream.end();) {
    const auto begin = start + 3;
    start = next_unit(begin);
    auto end = start;
    while (end != begin && end[-1] == 0) --end;
    if (begin == end) continue;
    constexpr int kTypeMask = 31;
    units.push_back(
        {.type = *begin & kTypeMask, .rbsp = without_emulation_prevention(Bytes(begin + 1, end))});
  }
  return units;
}

}  // namespace piblocks::h264
