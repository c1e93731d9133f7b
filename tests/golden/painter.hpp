// Which painters make the very pixels of the references: libraries and fonts that were tried.
// In: painters.txt, a line each. Out: whether this program's is one of them, or why it is not.
#pragma once

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include "draw/canvas.hpp"

namespace piblocks::testing_support {

/// How far a sample may be from the reference with other versions of the libraries.
inline constexpr int kOtherPainterDelta = 16;

struct PainterCheck {
  bool is_known = false;         ///< so that every pixel has to be the reference's
  bool has_known_fonts = false;  ///< so that samples differ by kOtherPainterDelta at most
  std::string reason;            ///< to skip a test whose pixels differ
};

inline PainterCheck check_painter() {
  const auto fonts_of = [](std::string_view painter) {
    return painter.substr(painter.find("fonts "));
  };
  const std::string painter = painter_fingerprint();
  PainterCheck check;
  std::ifstream known(PIBLOCKS_PAINTERS);
  for (std::string line; std::getline(known, line);) {
    check.is_known |= line == painter;
    check.has_known_fonts |= fonts_of(line) == fonts_of(painter);
  }
  check.reason = "painted by " + painter + ", which is not in tests/golden/painters.txt";
  return check;
}

}  // namespace piblocks::testing_support
