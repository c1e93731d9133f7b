// What a line of text on the picture may be.
// In: text. Out: why it cannot be drawn, or nothing.
#pragma once

#include <string>
#include <string_view>

namespace piblocks {

/// Whether it has a line break, a tab or another control character.
bool has_control_characters(std::string_view text);

/// What is wrong with a title, a caption or a line of a card; empty if nothing is.
std::string problem_of_line(std::string_view text);

}  // namespace piblocks
