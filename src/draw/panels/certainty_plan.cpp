#include "draw/panels/certainty_plan.hpp"

#include <algorithm>
#include <utility>

#include "draw/text_lines.hpp"

namespace piblocks {
namespace {

// In ems. More room is given to the lens and the notes, up to these.
constexpr double kLeastLens = 1.6;
constexpr double kMoreLens = 3;
constexpr double kMoreNotes = 1.2;
/// Height that longer notes leave free, so that not all is tight.
constexpr double kLoose = 1;

/// Ends with long labels take at most this part of the width.
constexpr double kMostEnds = 0.3;
/// The excess of pi/theta over pi/s is enlarged to at most this part of a line, by the largest
/// power of ten.
constexpr double kMostShown = 0.55;
/// Sums of the same widths in different order differ by less.
constexpr double kNegligibleWidth_px = 1e-6;

class CertaintyPlanner {
 public:
  CertaintyPlanner(const CertaintyRoom& room, const Certainty& numbers, const CertaintyWords& words)
      : room_(room),
        numbers_(numbers),
        words_(words),
        em_(room.em),
        left_(room.inside.x),
        right_(left_ + room.inside.width) {}

  std::optional<CertaintyPlan> run() {
    plan_.middle = numbers_.fraction() + numbers_.excess() / 2;
    if (numbers_.is_wrong()) {
      plan_.units = 2;
    } else {
      for (Rational shown = numbers_.excess() * 10; shown <= kMostShown; shown *= 10) {
        ++plan_.exponent;
      }
    }
    place_line();
    place_marks();
    if (!place_notes()) return std::nullopt;
    return std::move(plan_);
  }

 private:
  double width(const Formula& formula) const { return formula.width_em() * em_; }
  bool is_enlarged() const { return plan_.exponent > 0; }

  /// Both lines have the labels of the first one's ends beside them.
  void place_line() {
    const double room = right_ - left_;
    for (CertaintyWords::Pair& ends : words_.ends()) {
      plan_.ends = std::move(ends);
      if (width(plan_.ends.left) + width(plan_.ends.right) <= kMostEnds * room) break;
    }
    double beside = width(plan_.ends.left);
    if (is_enlarged()) beside = std::max(beside, width(words_.magnification(plan_.exponent)));
    plan_.line = {left_ + beside + certainty::kBeside * em_,
                  right_ - width(plan_.ends.right) - certainty::kBeside * em_};
  }

  /// The labels of pi/s and pi/theta, left and right of the band if possible.
  void place_marks() {
    const Rational from = numbers_.fraction();
    const Rational to = from + numbers_.excess();
    XRange room{left_, right_};
    XRange band{plan_.x_of(from), plan_.x_of(to)};
    if (is_enlarged()) {
      room = {plan_.line.left + certainty::kBeside * em_,
              plan_.line.right - certainty::kBeside * em_};
      band = {plan_.enlarged_x_of(from), plan_.enlarged_x_of(to)};
    }
    auto& [first, second] = plan_.marks;
    for (const CertaintyWords::Pair& pair : words_.marks()) {
      const double between = certainty::kBetween * em_;
      const double right = std::min(band.right, room.right - width(pair.right));
      first = {pair.left,
               std::max(room.left, std::min(band.left, right - between) - width(pair.left))};
      second = {pair.right, std::max(right, first.x + width(pair.left) + between)};
      if (second.x + width(pair.right) <= room.right + kNegligibleWidth_px) break;
    }
    above_px_ = second.x + width(second.formula);
    if (!is_enlarged()) return;
    const Formula names = words_.mark_names();
    const double most = std::max(left_, right_ - width(names));
    plan_.mark_names = {names, std::clamp(plan_.x_of(from) - width(names) / 2, left_, most)};
    above_px_ = plan_.mark_names->x + width(names);
  }

  /// Nothing if a word is too long.
  std::optional<std::vector<Formula>> lines_of(const Words& words) const {
    const auto fits = [&](const Formula& line) { return width(line) <= right_ - left_; };
    std::vector<Formula> lines = filled_lines(words, words_.space(), fits);
    if (!std::ranges::all_of(lines, fits)) return std::nullopt;
    return lines;
  }

  /// @returns their height in ems, or nothing if a word is too long.
  std::optional<double> set_notes(const std::vector<Words>& notes) {
    plan_.notes.clear();
    double height = certainty::kToNotes - certainty::kNoteStep - certainty::kBetweenNotes;
    for (const Words& note : notes) {
      auto lines = lines_of(note);
      if (!lines) return std::nullopt;
      height += certainty::kBetweenNotes + certainty::kNoteStep * double(lines->size());
      plan_.notes.push_back(std::move(*lines));
    }
    return height;
  }

  /// The longest notes, and what is beyond the line's end, as there is room.
  bool place_notes() {
    double room =
        room_.inside.height / em_ - certainty::kCap - certainty::kToLine - certainty::kFromLine;
    if (is_enlarged()) room -= kLeastLens + certainty::kToLine;
    for (const std::vector<Words>& notes : words_.notes(room_.is_defined)) {
      const std::optional<double> height = set_notes(notes);
      const double loose = notes.size() > 1 ? kLoose : 0;
      if (!height || *height + loose > room) continue;
      double spare = room - *height;
      place_next_whole_meaning(spare);
      if (plan_.has_row_above) spare -= certainty::kRow;
      if (is_enlarged()) {
        const double more = std::min(spare / 2, kMoreLens);
        plan_.lens_em = kLeastLens + more;
        spare -= more;
      }
      plan_.notes_em = std::min(spare / 2, kMoreNotes);
      return true;
    }
    return false;
  }

  /// @param spare  height that is left, in ems
  void place_next_whole_meaning(double spare) {
    for (const Formula& formula : words_.next_whole_meaning()) {
      const double x = right_ - width(formula);
      const bool is_beside = x >= above_px_ + certainty::kBetween * em_;
      if (x < left_ || (!is_beside && spare < certainty::kRow)) continue;
      plan_.next_whole_meaning = {formula, x};
      plan_.has_row_above = !is_beside;
      return;
    }
  }

  const CertaintyRoom& room_;
  const Certainty& numbers_;
  const CertaintyWords& words_;
  double em_;
  double left_;
  double right_;
  double above_px_ = 0;  ///< right end of the labels above the first line
  CertaintyPlan plan_;
};

}  // namespace

std::optional<CertaintyPlan> plan_certainty(const CertaintyRoom& room, const Certainty& numbers,
                                            const CertaintyWords& words) {
  return CertaintyPlanner(room, numbers, words).run();
}

}  // namespace piblocks
