// Lines of a title or a caption.
// In: a text and its room. Out: lines that fit, or a message that says why there are none.
#pragma once

#include <string>
#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

struct LineRoom {
  const char* key = "";  ///< of the scene, named in messages
  double size_px = 0;    ///< of the type
  double width_px = 0;
};

/// Breaks a text between words. @throws UsageError if a word, or the text, is too long.
std::vector<std::string> break_lines(const Font& font, const std::string& text,
                                     const LineRoom& room);

/// @param key  of the scene
/// @throws UsageError, always
[[noreturn]] void throw_too_long(const char* key, const std::string& text, double room_px);

/// @param key  of the scene
/// @throws UsageError if a glyph is missing, or the frame is too small for any text.
void check_readable(const DrawingContext& context, const char* key, const std::string& text);

}  // namespace piblocks
