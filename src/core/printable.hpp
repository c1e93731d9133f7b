// Text from files and names, for terminals, HTML and XML.
// In: any bytes. Out: the same text in valid UTF-8, without characters that a terminal obeys, that
// change the direction of text, or that XML does not allow: "\x1b" instead of ESC.
#pragma once

#include <string>
#include <string_view>

namespace piblocks {

/// Writes control characters of ASCII and bytes that are not UTF-8 as "\xHH", "\n" and "\t", and
/// other characters of this kind as "\u{HHHH}".
std::string printable(std::string_view text);

/// The same with the special characters of HTML and XML escaped, in attributes too.
std::string escaped(std::string_view text);

}  // namespace piblocks
