// Where the panel of certainty has its lines and texts.
// In: its room, numbers and words. Out: places, or nothing if there is too little room.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "draw/panels/certainty.hpp"
#include "draw/panels/certainty_words.hpp"

namespace piblocks {

struct CertaintyRoom {
  Rectangle inside;
  double em = 0;
  bool is_defined = false;  ///< whether theta and s are explained outside
};

/// Part of a row, in pixels.
struct XRange {
  double left = 0;
  double right = 0;
};

/// In ems.
namespace certainty {

inline constexpr double kCap = 0.73;     ///< from a text's top to its baseline
inline constexpr double kToLine = 0.75;  ///< from the baseline of labels down to their line
/// From a line down to the baseline of the label below it.
inline constexpr double kFromLine = 1.3;
inline constexpr double kToNotes = 1.5;    ///< from there to the first line of notes
inline constexpr double kNoteStep = 1.25;  ///< from line to line
inline constexpr double kBetweenNotes = 0.2;
inline constexpr double kRow = 1.25;
inline constexpr double kBeside = 0.5;  ///< between a line and its ends' labels
inline constexpr double kBetween = 1;   ///< between labels side by side

}  // namespace certainty

struct CertaintyPlan {
  struct Label {
    Formula formula;
    double x = 0;  ///< left end
  };

  /// Place on the first line. @param fraction  beyond its left end's whole number
  double x_of(const Rational& fraction) const {
    return line.left + to_double(fraction / units) * (line.right - line.left);
  }
  /// Place on the enlarged line, whose middle is `middle`.
  double enlarged_x_of(const Rational& fraction) const {
    const Rational zoom = power(10, static_cast<unsigned long>(exponent));
    return x_of(Rational(1, 2) + (fraction - middle) * zoom);
  }

  int units = 1;      ///< length of the first line
  long exponent = 0;  ///< the second line is 10^n times as large; 0 if there is none
  Rational middle;    ///< of the band from pi/s to pi/theta
  XRange line;        ///< both lines
  CertaintyWords::Pair ends;
  std::array<Label, 2> marks;               ///< above the line that shows the band best
  std::optional<Label> mark_names;          ///< above the first line, if marks are above the second
  std::optional<Label> next_whole_meaning;  ///< right of them
  bool has_row_above = false;               ///< which next_whole_meaning is in
  std::vector<std::vector<Formula>> notes;  ///< lines of paragraphs
  double lens_em = 0;   ///< from the first line to the baseline of the second one's labels
  double notes_em = 0;  ///< room above the notes, beside what is always there
};

std::optional<CertaintyPlan> plan_certainty(const CertaintyRoom& room, const Certainty& numbers,
                                            const CertaintyWords& words);

}  // namespace piblocks
