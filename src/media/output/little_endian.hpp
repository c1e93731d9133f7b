// Whole numbers as bytes, the lowest byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace piblocks {

/// Appends the lowest `size_bytes` bytes, at most 8.
inline void append_little_endian(std::vector<std::uint8_t>& bytes, std::uint64_t value,
                                 std::size_t size_bytes) {
  for (std::size_t i = 0; i < size_bytes; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

/// The number in at most 8 bytes.
inline std::uint64_t from_little_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) value |= std::uint64_t{bytes[i]} << (8 * i);
  return value;
}

}  // namespace piblocks
