// Reads the numbers that BitWriter writes.
// In: the bytes of an RBSP. Out: numbers in the codes of ITU-T H.264, clauses 7.2 and 9.1.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "h264/error.hpp"

namespace piblocks::h264 {

/// Every function that reads throws HeaderError where the bits end.
class BitReader {
 public:
  /// @param rbsp  must outlive the reader.
  explicit BitReader(std::span<const std::uint8_t> rbsp) : bytes_(rbsp), end_(stop_bit(rbsp)) {}

  /// u(n): `count` is from 0 to 32.
  std::uint32_t get(int count) {
    assert(count >= 0 && count <= 32);
    std::uint32_t value = 0;
    for (; count > 0; --count) value = value << 1 | (get_flag() ? 1 : 0);
    return value;
  }
  bool get_flag() {
    if (!has_more_data()) throw HeaderError("h264: a header ends too early");
    const bool flag = (bytes_[position_ / 8] >> (7 - position_ % 8) & 1) != 0;
    ++position_;
    return flag;
  }
  /// ue(v), 9.1
  std::uint32_t get_unsigned() {
    int zeros = 0;
    while (!get_flag()) ++zeros;
    if (zeros > 31) throw HeaderError("h264: a header has a number of more than 32 bits");
    return (1U << zeros) - 1 + get(zeros);
  }
  /// se(v), 9.1.1
  std::int32_t get_signed() {
    const std::uint32_t code = get_unsigned();
    const auto half = static_cast<std::int32_t>(code / 2);
    return code % 2 == 0 ? -half : half + 1;
  }
  /// more_rbsp_data(), 7.2: whether there are bits before the trailing bits.
  bool has_more_data() const noexcept { return position_ < end_; }

 private:
  /// The position of rbsp_stop_one_bit, or 0 if there is none.
  static std::size_t stop_bit(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty() && bytes.back() == 0) bytes = bytes.first(bytes.size() - 1);
    if (bytes.empty()) return 0;
    return 8 * bytes.size() - 1 - static_cast<std::size_t>(std::countr_zero(bytes.back()));
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  std::size_t end_;  // of the data, in bits
};

}  // namespace piblocks::h264
