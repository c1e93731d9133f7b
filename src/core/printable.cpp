#include "core/printable.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/utf8.hpp"

namespace piblocks {
namespace {

bool is_plain(std::uint32_t code) {
  const auto is_in = [code](std::uint32_t first, std::uint32_t last) {
    return code >= first && code <= last;
  };
  if (code < 0x20 || is_in(0x7f, 0x9f)) return false;                // C0, DEL, C1
  if (is_in(0x200e, 0x200f) || code == 0x061c) return false;         // marks of direction
  if (is_in(0x2028, 0x202e) || is_in(0x2066, 0x2069)) return false;  // lines, embeddings, isolates
  return code != 0xfeff && (code & 0xfffe) != 0xfffe;  // byte order mark, noncharacters
}

std::string escape(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  return code < 0x80 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{{{:x}}}", code);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto [code, length_bytes] = first_character(text);
    if (length_bytes == 0) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
      text.remove_prefix(1);
      continue;
    }
    result += is_plain(code) ? std::string(text.substr(0, length_bytes)) : escape(code);
    text.remove_prefix(length_bytes);
  }
  return result;
}

std::string escaped(std::string_view text) {
  constexpr std::string_view kSpecial = "&<>\"'";
  constexpr std::array kEntities = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  std::string result;
  for (const char c : printable(text)) {
    const std::size_t at = kSpecial.find(c);
    if (at == std::string_view::npos) {
      result += c;
    } else {
      result += kEntities.at(at);
    }
  }
  return result;
}

}  // namespace piblocks
