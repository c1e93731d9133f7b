#include "draw/text_widths.hpp"

#include <algorithm>

namespace piblocks {

std::size_t first_character(std::string_view text) {
  std::size_t length = text.empty() ? 0 : 1;
  while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80)
    ++length;
  return length;
}

TextWidths::TextWidths(const Font& font, std::string_view characters) {
  while (!characters.empty()) {
    const std::string character(characters.substr(0, first_character(characters)));
    advances_.try_emplace(character, font.width_em(character));
    characters.remove_prefix(character.size());
  }
}

double TextWidths::width_em(std::string_view text) const {
  double sum = 0;
  while (!text.empty()) {
    const std::string_view character = text.substr(0, first_character(text));
    const auto found = advances_.find(character);
    if (found != advances_.end()) sum += found->second;
    text.remove_prefix(character.size());
  }
  return sum;
}

}  // namespace piblocks
