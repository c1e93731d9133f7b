// What text cannot be set letter by letter.
// In: a line of UTF-8. Out: the first character that needs more than its glyph.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace piblocks {

struct Unshaped {
  std::string name;    ///< "U+0301"; of a letter "'ش' (U+0634)"
  const char* reason;  ///< "is in a script that needs shaping"
  const char* remedy;  ///< "use another script"
};

/// The first character whose glyph depends on its neighbours, that is written from right to left,
/// or that is an instruction. @param utf8  valid
std::optional<Unshaped> first_unshaped(std::string_view utf8);

}  // namespace piblocks
