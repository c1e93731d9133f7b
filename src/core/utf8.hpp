// The characters of a text in UTF-8, one by one.
// In: any bytes. Out: a code point and its length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace piblocks {

struct Character {
  std::uint32_t code = 0;
  std::size_t length_bytes = 0;  ///< 0 if the bytes are not UTF-8
};

/// RFC 3629: the shortest form only, no surrogates, nothing above U+10FFFF.
/// @param text  not empty
inline Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
  std::uint32_t code = lead & (0xffU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const std::uint32_t lowest = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0x80;
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < lowest || code > 0x10ffff || is_surrogate) return {};
  return {code, length};
}

}  // namespace piblocks
