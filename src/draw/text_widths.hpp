// Widths of texts that change from frame to frame.
// In: the characters they are made of, once. Out: sums of advances, without the font.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "draw/font.hpp"

namespace piblocks {

/// Const members are thread-safe.
class TextWidths {
 public:
  /// @param characters  all that may occur, in UTF-8.
  TextWidths(const Font& font, std::string_view characters);
  /// Width of a line of these characters, in ems.
  double width_em(std::string_view text) const;

 private:
  std::map<std::string, double, std::less<>> advances_;
};

/// Bytes of the character that a valid UTF-8 text begins with.
std::size_t first_character(std::string_view text);

/// All that numbers are written with in pictures.
inline constexpr std::string_view kNumberCharacters = "0123456789,.−×⁰¹²³⁴⁵⁶⁷⁸⁹";

}  // namespace piblocks
