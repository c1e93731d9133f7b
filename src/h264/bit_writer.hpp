// Bits of an H.264 stream, the first one highest in its byte.
// In: numbers in the codes of ITU-T H.264, clauses 7.2 and 9.1. Out: bytes.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

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

}  // namespace piblocks::h264
