// Lines of a title or a caption.
// In: a text and its room. Out: lines that fit, or a message that says why there are none.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

struct LineRoom {
  const char* key = "";  ///< of the scene, named in messages
  double size_px = 0;    ///< of the type
  double width_px = 0;
};

/// Fills lines with words, as many as fit. A word that does not fit has a line of its own.
/// @param space  between words
template <typename Word>
std::vector<Word> filled_lines(const std::vector<Word>& words, const Word& space,
                               const auto& fits) {
  std::vector<Word> lines;
  for (const Word& word : words) {
    if (lines.empty()) {
      lines.push_back(word);
      continue;
    }
    Word longer = lines.back();
    longer += space;
    longer += word;
    if (fits(longer)) {
      lines.back() = std::move(longer);
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

/// Breaks a text between words. @throws UsageError if a word, or the text, is too long.
std::vector<std::string> break_lines(const Font& font, const std::string& text,
                                     const LineRoom& room);

/// @param key  of the scene
/// @throws UsageError, always
[[noreturn]] void throw_too_long(const char* key, const std::string& text, double room_px);

/// @param key  of the scene
/// @throws UsageError if a glyph is missing, or the frame is too small for any text.
void check_readable(const LayoutContext& context, const char* key, const std::string& text);

}  // namespace piblocks
