#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "core/text.hpp"
#include "draw/font.hpp"

namespace piblocks {
namespace {

/// Both ends included.
struct CodeRange {
  std::uint32_t first;
  std::uint32_t last;
};

// Blocks of the Unicode Standard, version 15, including their unassigned characters. Characters
// that the font has no glyph for need not be here.

/// Marks that stand over, under or within the letter before.
constexpr std::array kMarks{
    CodeRange{0x0300, 0x036F},   CodeRange{0x0483, 0x0489},   CodeRange{0x135D, 0x135F},
    CodeRange{0x1AB0, 0x1AFF},   CodeRange{0x1DC0, 0x1DFF},   CodeRange{0x20D0, 0x20FF},
    CodeRange{0x2CEF, 0x2CF1},   CodeRange{0x2D7F, 0x2D7F},   CodeRange{0x2DE0, 0x2DFF},
    CodeRange{0x302A, 0x302F},   CodeRange{0x3099, 0x309A},   CodeRange{0xA66F, 0xA672},
    CodeRange{0xA674, 0xA67D},   CodeRange{0xA69E, 0xA69F},   CodeRange{0xA6F0, 0xA6F1},
    CodeRange{0xFE20, 0xFE2F},   CodeRange{0x1D165, 0x1D169}, CodeRange{0x1D16D, 0x1D172},
    CodeRange{0x1D17B, 0x1D182}, CodeRange{0x1D185, 0x1D18B}, CodeRange{0x1D1AA, 0x1D1AD},
    CodeRange{0x1D242, 0x1D244}, CodeRange{0x1E000, 0x1E02F}, CodeRange{0x1E130, 0x1E136}};

/// Instructions to a program that sets text: joiners, directions, variants, line ends.
constexpr std::array kControls{
    CodeRange{0x0000, 0x001F},  CodeRange{0x007F, 0x009F}, CodeRange{0x00AD, 0x00AD},
    CodeRange{0x061C, 0x061C},  CodeRange{0x180B, 0x180F}, CodeRange{0x200B, 0x200F},
    CodeRange{0x2028, 0x202E},  CodeRange{0x2060, 0x206F}, CodeRange{0xFE00, 0xFE0F},
    CodeRange{0xFEFF, 0xFEFF},  CodeRange{0xFFF9, 0xFFFB}, CodeRange{0x1F3FB, 0x1F3FF},
    CodeRange{0xE0000, 0xE0FFF}};

/// Scripts from right to left, scripts whose letters join, and those of India and its neighbours,
/// whose letters change places.
constexpr std::array kScripts{
    CodeRange{0x0590, 0x109F}, CodeRange{0x1100, 0x11FF},   CodeRange{0x1700, 0x18AF},
    CodeRange{0x1900, 0x194F}, CodeRange{0x1A00, 0x1AAF},   CodeRange{0x1B00, 0x1C4F},
    CodeRange{0x1CC0, 0x1CFF}, CodeRange{0xA800, 0xA82F},   CodeRange{0xA840, 0xAAFF},
    CodeRange{0xABC0, 0xABFF}, CodeRange{0xD7B0, 0xD7FF},   CodeRange{0xFB1D, 0xFDFF},
    CodeRange{0xFE70, 0xFEFE}, CodeRange{0x10800, 0x11FFF}, CodeRange{0x1E800, 0x1EFFF}};

bool holds(std::span<const CodeRange> ranges, std::uint32_t code) {
  return std::ranges::any_of(
      ranges, [code](const CodeRange& range) { return code >= range.first && code <= range.last; });
}

struct Kind {
  std::span<const CodeRange> ranges;
  bool is_letter;  ///< and can be shown in a message
  const char* reason;
  const char* remedy;
};

constexpr std::array kKinds{
    Kind{kControls, false, "is an instruction for shaping text, which is set letter by letter here",
         "leave it out"},
    Kind{kMarks, false,
         "is a combining mark, which needs shaping, and text is set letter by letter here",
         "use a letter that has the mark"},
    Kind{kScripts, true, "is in a script that needs shaping, and text is set letter by letter here",
         "use another script, or a picture as the logo"}};

}  // namespace

std::string shaping_problem(std::string_view utf8) {
  while (!utf8.empty()) {
    const auto [code, length_bytes] = first_character(utf8);
    for (const Kind& kind : kKinds) {
      if (!holds(kind.ranges, code)) continue;
      const std::string letter =
          kind.is_letter ? fmt::format("'{}' (U+{:04X})", utf8.substr(0, length_bytes), code)
                         : fmt::format("U+{:04X}", code);
      return fmt::format("{} {}; {}", letter, kind.reason, kind.remedy);
    }
    utf8.remove_prefix(length_bytes);
  }
  return {};
}

}  // namespace piblocks
