// Bytes in memory, and whole numbers in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace piblocks {

using Bytes = std::vector<std::uint8_t>;
using ByteSpan = std::span<const std::uint8_t>;

inline void append(Bytes& bytes, ByteSpan more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}
inline void append(Bytes& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

/// Appends the lowest `size_bytes` bytes, at most 8, the lowest first.
inline void append_little_endian(Bytes& bytes, std::uint64_t value, std::size_t size_bytes) {
  for (std::size_t i = 0; i < size_bytes; ++i) bytes.push_back(std::uint8_t(value >> (8 * i)));
}
/// The same, the lowest last.
inline void append_big_endian(Bytes& bytes, std::uint64_t value, std::size_t size_bytes) {
  for (std::size_t i = size_bytes; i-- > 0;) bytes.push_back(std::uint8_t(value >> (8 * i)));
}

/// The number in at most 8 bytes, the lowest first.
inline std::uint64_t from_little_endian(ByteSpan bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) value |= std::uint64_t{bytes[i]} << (8 * i);
  return value;
}

/// The same, the lowest last.
inline std::uint64_t from_big_endian(ByteSpan bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8 | byte;
  return value;
}

}  // namespace piblocks
