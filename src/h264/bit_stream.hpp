// Bits of an H.264 stream, the first one highest in its byte.
// In: numbers, or the bytes of an RBSP. Out: bytes, or numbers, in the codes of ITU-T H.264,
// clauses 7.2 and 9.1.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "h264/encoder.hpp"

namespace piblocks::h264 {

class BitWriter {
 public:
  /// u(n): the lowest `count` bits of `value`, which has no others. `count` is from 0 to 32.
  void put(std::uint32_t value, int count) {
    assert(count >= 0 && count <= 32 && (count == 32 || value >> count == 0));
    waiting_ = waiting_ << count | value;
    waiting_count_ += count;
    if (waiting_count_ >= 32) {
      waiting_count_ -= 32;
      store(static_cast<std::uint32_t>(waiting_ >> waiting_count_), 4);
    }
  }
  void put_flag(bool value) { put(value ? 1 : 0, 1); }
  /// ue(v), 9.1: `value` is below 2^32 - 1.
  void put_unsigned(std::uint32_t value) {
    const int size = static_cast<int>(std::bit_width(value + 1));
    put(0, size - 1);
    put(value + 1, size);
  }
  /// se(v), 9.1.1
  void put_signed(std::int32_t value) {
    put_unsigned(value > 0 ? 2 * static_cast<std::uint32_t>(value) - 1
                           : 2 * static_cast<std::uint32_t>(-value));
  }
  /// rbsp_trailing_bits(), 7.3.2.11
  void put_trailing_bits() {
    put(1, 1);
    align();
  }
  /// Zeros up to the next whole byte.
  void align() {
    put(0, -waiting_count_ & 7);
    const int whole = std::exchange(waiting_count_, 0) / 8;
    store(static_cast<std::uint32_t>(waiting_ << (32 - 8 * whole)), whole);
  }
  void append(const BitWriter& other) {
    for (const std::uint8_t byte : other.bytes()) put(byte, 8);
    if (other.waiting_count_ > 0) {
      const std::uint64_t mask = (std::uint64_t{1} << other.waiting_count_) - 1;
      put(static_cast<std::uint32_t>(other.waiting_ & mask), other.waiting_count_);
    }
  }

  /// Bits of `bytes`, from `begin` to before `end`.
  void append(std::span<const std::uint8_t> bytes, std::size_t begin, std::size_t end) {
    while (begin < end) {
      const std::size_t count = std::min(8 - begin % 8, end - begin);
      const unsigned rest = unsigned{bytes[begin / 8]} >> (8 - begin % 8 - count);
      put(rest & ((1U << count) - 1), static_cast<int>(count));
      begin += count;
      // Then whole words, as long as there are any.
      for (; end - begin >= 32; begin += 32) {
        const std::uint8_t* const at = bytes.data() + begin / 8;
        put(std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 |
                at[3],
            32);
      }
    }
  }

  std::size_t bit_count() const noexcept {
    return 8 * size_ + static_cast<std::size_t>(waiting_count_);
  }
  /// All bits, after put_trailing_bits() or align().
  std::span<const std::uint8_t> bytes() const noexcept { return {room_.data(), size_}; }
  void clear() noexcept {
    size_ = 0;
    waiting_count_ = 0;
  }

 private:
  static constexpr std::size_t kFirstRoom_bytes = 512;  // more than any macroblock has

  /// Appends the highest `count` bytes of a word. The others are overwritten later.
  void store(std::uint32_t word, int count) {
    if (room_.size() < size_ + 4) room_.resize(std::max(kFirstRoom_bytes, 2 * room_.size()));
    std::uint8_t* const at = room_.data() + size_;
    for (int i = 0; i < 4; ++i) at[i] = static_cast<std::uint8_t>(word >> (24 - 8 * i));
    size_ += static_cast<std::size_t>(count);
  }

  std::vector<std::uint8_t> room_;
  std::size_t size_ = 0;       // bytes written into room_
  std::uint64_t waiting_ = 0;  // only the lowest waiting_count_ bits count
  int waiting_count_ = 0;      // less than 32
};

/// A header of a stream is broken, or is not ours.
struct HeaderError : Error {
  using Error::Error;
};

/// Reads what BitWriter writes. Every function that reads throws HeaderError where the bits end.
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
