#include "h264/cavlc.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>

namespace piblocks::h264 {
namespace {

constexpr std::size_t kMaxLevels = 16;
[[maybe_unused]] constexpr std::size_t kChromaDcLevels = 4;

/// The levels that are not zero, in the order of writing: the last one of the scan first.
struct Coefficients {
  std::size_t total = 0;
  std::size_t trailing_ones = 0;
  std::size_t total_zeros = 0;                      // before the last level
  std::array<std::int16_t, kMaxLevels + 1> levels;  // the first `total` are valid
  std::array<std::uint8_t, kMaxLevels> runs;  // zeros between a level and the one after, likewise
};

Coefficients coefficients_of(std::span<const std::int16_t> levels) {
  Coefficients found;
  // Without branches: a zero is overwritten by the level that comes next.
  std::array<std::uint8_t, kMaxLevels + 1> places;
  std::size_t total = 0;
  for (std::size_t i = levels.size(); i-- > 0;) {
    found.levels[total] = levels[i];
    places[total] = static_cast<std::uint8_t>(i);
    total += levels[i] != 0 ? 1 : 0;
  }
  found.total = total;
  if (total == 0) return found;
  found.total_zeros = places[0] + 1U - total;
  for (std::size_t k = 0; k + 1 < total; ++k) {
    found.runs[k] = static_cast<std::uint8_t>(places[k] - places[k + 1] - 1);
  }
  const std::size_t most = std::min<std::size_t>(total, 3);
  while (found.trailing_ones < most && std::abs(found.levels[found.trailing_ones]) == 1) {
    ++found.trailing_ones;
  }
  return found;
}

/// Bits of a block, which wait in registers: a BitWriter is in memory.
class WaitingBits {
 public:
  explicit WaitingBits(BitWriter& writer) : writer_(writer) {}

  /// As BitWriter::put().
  void put(std::uint32_t value, int count) {
    if (count_ + count > 64) flush();
    value_ = value_ << count | value;
    count_ += count;
  }
  void put(const Code& code) {
    assert(code.length > 0);
    put(code.bits, code.length);
  }
  /// To be called in the end.
  void flush() {
    const int high = std::max(count_ - 32, 0);
    writer_.put(static_cast<std::uint32_t>(high == 0 ? 0 : value_ >> 32 & ((1ULL << high) - 1)),
                high);
    const int low = count_ - high;
    writer_.put(static_cast<std::uint32_t>(value_ & ((1ULL << low) - 1)), low);
    count_ = 0;
  }

 private:
  BitWriter& writer_;
  std::uint64_t value_ = 0;  // only the lowest count_ bits count
  int count_ = 0;
};

void put_token(const Coefficients& block, int nc, WaitingBits& bits) {
  const auto put_from = [&](const auto& table) {
    bits.put(table[block.total][block.trailing_ones]);
  };
  if (nc == kChromaDc) return put_from(kChromaDcTokens);
  if (nc < 2) return put_from(kCoefficientTokens[0]);
  if (nc < 4) return put_from(kCoefficientTokens[1]);
  if (nc < 8) return put_from(kCoefficientTokens[2]);
  // TotalCoeff - 1 and TrailingOnes; for no levels a pair that does not occur.
  const std::size_t token = block.total == 0 ? 3 : (block.total - 1) << 2 | block.trailing_ones;
  bits.put(static_cast<std::uint32_t>(token), 6);
}

/// level_prefix and level_suffix for levelCode, 9.2.2.1.
bool put_level_code(int code, int suffix_length, WaitingBits& bits) {
  constexpr int kEscapePrefix = 15;
  constexpr int kEscapeBits = 12;
  // Without a suffix, prefix 14 has a suffix of four bits for the next 16 codes.
  const bool is_short_escape = suffix_length == 0 && code >= 14 && code < 30;
  const int first_escaped = suffix_length == 0 ? 30 : kEscapePrefix << suffix_length;
  int prefix = code >> suffix_length;
  int suffix = code & ((1 << suffix_length) - 1);
  int suffix_bits = suffix_length;
  if (is_short_escape) {
    prefix = 14;
    suffix = code - 14;
    suffix_bits = 4;
  } else if (code >= first_escaped) {
    prefix = kEscapePrefix;
    suffix = code - first_escaped;
    suffix_bits = kEscapeBits;
    if (suffix >> kEscapeBits != 0) return false;
  }
  bits.put(1U << suffix_bits | static_cast<std::uint32_t>(suffix), prefix + 1 + suffix_bits);
  return true;
}

/// The levels after the trailing ones.
bool put_large_levels(const Coefficients& block, WaitingBits& bits) {
  constexpr int kMaxSuffixLength = 6;
  int suffix_length = block.total > 10 && block.trailing_ones < 3 ? 1 : 0;
  for (std::size_t i = block.trailing_ones; i < block.total; ++i) {
    const int level = block.levels[i];
    int code = level > 0 ? 2 * level - 2 : -2 * level - 1;
    // 1 and -1 would be one more trailing one.
    if (i == block.trailing_ones && i < 3) code -= 2;
    if (!put_level_code(code, suffix_length, bits)) return false;
    suffix_length = std::max(suffix_length, 1);
    if (std::abs(level) > 3 << (suffix_length - 1) && suffix_length < kMaxSuffixLength) {
      ++suffix_length;
    }
  }
  return true;
}

void put_runs(const Coefficients& block, WaitingBits& bits) {
  std::size_t zeros_left = block.total_zeros;
  for (std::size_t i = 0; i + 1 < block.total && zeros_left > 0; ++i) {
    bits.put(kRunsBefore[std::min(zeros_left, kRunsBefore.size()) - 1][block.runs[i]]);
    zeros_left -= block.runs[i];
  }
}

}  // namespace

bool write_levels(std::span<const std::int16_t> levels, int total, int nc, BitWriter& writer) {
  assert(levels.size() == 15 || levels.size() == kMaxLevels || levels.size() == kChromaDcLevels);
  assert((nc == kChromaDc) == (levels.size() == kChromaDcLevels));
  WaitingBits bits(writer);
  if (total == 0) {
    put_token(Coefficients{}, nc, bits);
    bits.flush();
    return true;
  }
  const Coefficients block = coefficients_of(levels);
  assert(block.total == static_cast<std::size_t>(total));
  put_token(block, nc, bits);
  for (std::size_t i = 0; i < block.trailing_ones; ++i) bits.put(block.levels[i] < 0 ? 1 : 0, 1);
  if (!put_large_levels(block, bits)) return false;
  if (block.total < levels.size()) {
    bits.put(nc == kChromaDc ? kChromaDcTotalZeros[block.total - 1][block.total_zeros]
                             : kTotalZeros[block.total - 1][block.total_zeros]);
    put_runs(block, bits);
  }
  bits.flush();
  return true;
}

}  // namespace piblocks::h264
