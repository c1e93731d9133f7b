// Boxes, of which MP4 files consist (ISO/IEC 14496-12, 4.2): a size, four letters, and a content.
// In: numbers, texts and the boxes that hold them. Out: bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

namespace piblocks::h264 {

/// Boxes, one in another. Numbers have their highest byte first.
class BoxWriter {
 public:
  explicit BoxWriter(std::uint64_t later_bytes) : later_bytes_(later_bytes) {}

  void put(std::uint64_t value, int size_bytes) {
    for (int shift = 8 * size_bytes - 8; shift >= 0; shift -= 8) {
      bytes_.push_back(static_cast<std::uint8_t>(value >> shift));
    }
  }
  /// Numbers of 32 bits.
  void put_all(std::initializer_list<std::uint64_t> values) {
    for (const std::uint64_t value : values) put(value, 4);
  }
  void put(std::span<const std::uint8_t> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void put(std::string_view text) {
    for (const char letter : text) put(static_cast<std::uint8_t>(letter), 1);
  }
  void put_zeros(std::size_t count) { bytes_.resize(bytes_.size() + count); }

  template <typename Fill>
  void box(std::string_view type, const Fill& fill) {
    sized_box(type, 0, fill);
  }
  /// A box that ends the index: its size includes what the caller writes behind all boxes.
  template <typename Fill>
  void last_box(std::string_view type, const Fill& fill) {
    sized_box(type, later_bytes_, fill);
  }

  const std::vector<std::uint8_t>& bytes() const noexcept { return bytes_; }

 private:
  template <typename Fill>
  void sized_box(std::string_view type, std::uint64_t later_bytes, const Fill& fill) {
    const std::size_t start = bytes_.size();
    put(0, 4);
    put(type);
    fill();
    const std::uint64_t size = bytes_.size() - start + later_bytes;
    for (std::size_t i = 0; i < 4; ++i) {
      bytes_[start + i] = static_cast<std::uint8_t>(size >> (24 - 8 * i));
    }
  }

  std::vector<std::uint8_t> bytes_;
  std::uint64_t later_bytes_;
};

}  // namespace piblocks::h264
