// The fonts that are part of the program.
// In: a face. Out: the bytes of its font file. font_data.S takes them in where binaries are ELF;
// elsewhere embed_fonts.cmake writes them down for the C compiler. The build takes one.
#pragma once

#include <cstddef>
#include <span>

#include "draw/font.hpp"

/// One of them. Both files above lay it out.
struct PiblocksEmbeddedFont {
  const unsigned char* begin;
  const unsigned char* end;
};

// In the order of Face.
// NOLINTNEXTLINE(readability-identifier-naming): no constant, but a symbol of assembler or C
extern "C" const PiblocksEmbeddedFont piblocks_fonts[];

namespace piblocks {

inline std::span<const unsigned char> embedded_font(Face face) noexcept {
  const PiblocksEmbeddedFont& font = piblocks_fonts[static_cast<std::size_t>(face)];
  return {font.begin, font.end};
}

}  // namespace piblocks
