#include "core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstdlib>

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

Character first_character(std::string_view text) {
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

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = first_character(text).length_bytes;
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kAround = " \t\r\n";
  const auto first = text.find_first_not_of(kAround);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kAround) - first + 1);
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 60;  // characters
  constexpr std::size_t kKept = 40;
  std::size_t kept_bytes = 0;
  std::size_t characters = 0;
  for (std::size_t at = 0; at < text.size(); at += step_bytes(text.substr(at))) {
    if (characters == kKept) kept_bytes = at;
    if (++characters > kMost) {
      return fmt::format("{}… ({} bytes)", text.substr(0, kept_bytes), text.size());
    }
  }
  return std::string(text);
}

std::string with_single_blanks(std::string_view line) {
  std::vector<std::string> words = split(line, ' ');
  std::erase(words, "");
  return fmt::format("{}", fmt::join(words, " "));
}

std::string counted(std::int64_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string with_short_words(std::string_view text) {
  constexpr std::size_t kMaxWord = 300;
  constexpr std::size_t kKept = 100;  // at either end
  // Where the character that this byte is in ends, if it is UTF-8.
  const auto end_of_character = [&](std::size_t at) {
    for (int i = 0; i < 3 && (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U; ++i) ++at;
    return at;
  };
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size() - 1) + 1;
    if (end - begin <= kMaxWord) {
      result += text.substr(begin, end - begin);
    } else {
      const std::size_t first = end_of_character(begin + kKept);
      const std::size_t last = end_of_character(end - kKept);
      result += fmt::format("{}[… {} bytes …]{}", text.substr(begin, first - begin), last - first,
                            text.substr(last, end - last));
    }
    begin = end;
  }
  return result;
}

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto [code, length_bytes] = first_character(text);
    if (length_bytes == 0) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    } else {
      result += is_plain(code) ? std::string(text.substr(0, length_bytes)) : escape(code);
    }
    text.remove_prefix(step_bytes(text));
  }
  return result;
}

std::string escaped(std::string_view text) {
  constexpr std::string_view kSpecial = "&<>\"'";
  constexpr std::array kEntities = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  std::string result;
  for (const char c : printable(text)) {
    const std::size_t at = kSpecial.find(c);
    result += at == std::string_view::npos ? std::string(1, c) : kEntities.at(at);
  }
  return result;
}

std::string rounded_down(double value) {
  if (value >= 1e3 && value < 1e15) return fmt::format("{:.0f}", std::floor(value));
  std::string text = fmt::format("{:.16e}", value);  // such as 2.9657000000000000e+00
  text.erase(5, text.find('e') - 5);
  return fmt::format("{:.4g}", std::strtod(text.c_str(), nullptr));
}

std::string json_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '<' || (c >= 0 && c < ' ')) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[(word >> (18 - 6 * k)) & 63] : '=';
    }
  }
  return text;
}

std::string data_address(std::string_view type, std::span<const std::uint8_t> bytes) {
  return fmt::format("data:{};base64,{}", type, base64(bytes));
}

std::string data_address(std::string_view type, std::string_view text) {
  return data_address(type, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace piblocks
