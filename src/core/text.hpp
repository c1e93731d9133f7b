// Text: its characters, its endings, and how bytes become text that is safe to show.
// In: any bytes. Out: code points, base64, and text for terminals, HTML, XML
// and JSON.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piblocks {

struct Character {
  std::uint32_t code = 0;
  std::size_t length_bytes = 0;  ///< 0 if the bytes are not UTF-8
};

/// The first character of a text that is not empty. RFC 3629: the shortest form only, no
/// surrogates, nothing above U+10FFFF.
Character first_character(std::string_view text);

/// How far to go to the next character: a byte if the first one is not UTF-8, so that every loop
/// over a text ends. @param text  not empty
inline std::size_t step_bytes(std::string_view text) {
  return std::max<std::size_t>(first_character(text).length_bytes, 1);
}

bool is_utf8(std::string_view text);

/// The text without the blanks, tabs and line ends around it.
std::string_view trimmed(std::string_view text);

/// For a message that repeats what a user has written: a text of more than 60 characters is cut to
/// its beginning and its length.
std::string shortened(std::string_view text);

/// The words of a line, with one blank between them; empty if it has none.
std::string with_single_blanks(std::string_view line);

/// The parts between separators: one more than there are of these.
std::vector<std::string> split(std::string_view text, char separator);

/// "1 frame", "2 frames". @param what  one of them
std::string counted(std::int64_t count, std::string_view what);

/// Whether a name has this file extension, in small letters or in capitals.
/// @param ending  in small letters, such as ".png".
constexpr bool has_ending(std::string_view name, std::string_view ending) {
  if (name.size() < ending.size()) return false;
  const auto is_same = [](char letter, char small) {
    return letter == small || (letter >= 'A' && letter <= 'Z' && letter - 'A' + 'a' == small);
  };
  return std::ranges::equal(name.substr(name.size() - ending.size()), ending, is_same);
}

/// For a message: leaves out the middle of every word of more than 300 bytes.
std::string with_short_words(std::string_view text);

/// The text in valid UTF-8, without characters that a terminal obeys, that change the direction of
/// text, or that XML does not allow. Control characters of ASCII and bytes that are not UTF-8
/// become "\xHH", "\n" and "\t", other characters of this kind "\u{HHHH}".
std::string printable(std::string_view text);

/// The same with the special characters of HTML and XML escaped, in attributes too.
std::string escaped(std::string_view text);

/// Four figures, or all before the point if they are more; never more than the value.
/// @param value  >= 0
std::string rounded_down(double value);

/// The text as a string of JSON (RFC 8259) in quotes, which a <script> element of HTML may hold.
/// @param text  UTF-8.
std::string json_text(std::string_view text);

/// Base64 (RFC 4648, section 4) in one line. The texts of consecutive pieces, all but the last a
/// multiple of three bytes long, make up the text of the whole.
std::string base64(std::span<const std::uint8_t> bytes);

/// An address (RFC 2397) that has the bytes themselves in it. @param type  such as "image/png"
std::string data_address(std::string_view type, std::span<const std::uint8_t> bytes);
std::string data_address(std::string_view type, std::string_view text);

}  // namespace piblocks
