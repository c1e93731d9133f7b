// Text from files and names, for terminals and reports.
// In: any bytes. Out: the same text in valid UTF-8, without characters that a terminal obeys, that
// change the direction of text, or that XML does not allow: "\x1b" in place of ESC.
#pragma once

#include <string>
#include <string_view>

namespace piblocks {

/// Writes control characters of ASCII and bytes that are not UTF-8 as "\xHH", "\n" and "\t", and
/// other characters of this kind as "\u{HHHH}".
std::string printable(std::string_view text);

}  // namespace piblocks
