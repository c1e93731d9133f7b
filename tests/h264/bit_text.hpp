// Bits as text.
#pragma once

#include <string>

#include "h264/bit_stream.hpp"

namespace piblocks::h264 {

inline std::string text_of(const BitWriter& bits) {
  BitWriter whole = bits;
  whole.align();
  std::string text;
  for (std::size_t i = 0; i < bits.bit_count(); ++i) {
    text += (whole.bytes()[i / 8] >> (7 - i % 8) & 1) != 0 ? '1' : '0';
  }
  return text;
}

/// Spaces may stand between the codes of expected bits.
inline std::string without_spaces(std::string text) {
  std::erase(text, ' ');
  return text;
}

}  // namespace piblocks::h264
