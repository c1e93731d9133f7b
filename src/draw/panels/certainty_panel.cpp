#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include "draw/look.hpp"
#include "draw/overlays/counter.hpp"
#include "draw/panels/certainty.hpp"
#include "draw/panels/certainty_words.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kBelowTitle = 0.77;  ///< from its baseline to the inside
constexpr double kCap = 0.73;         ///< from a text's top to its baseline
constexpr double kToLine = 0.75;      ///< from the baseline of labels down to their line
constexpr double kFromLine = 1.3;     ///< from a line down to the baseline of the label below it
constexpr double kToNotes = 1.5;      ///< from there to the first line of notes
constexpr double kNoteStep = 1.25;    ///< from line to line
constexpr double kBetweenNotes = 0.2;
constexpr double kRow = 1.25;
constexpr double kLens = 1.6;    ///< from a line to the labels of the one that enlarges it
constexpr double kBeside = 0.5;  ///< between a line and its ends' labels
constexpr double kBetween = 1;   ///< between labels side by side
constexpr double kEndTick = 0.42;
constexpr double kBand = 0.24;  ///< half of its height
constexpr double kTick = 0.16;
constexpr double kBetweenTicks = 0.8;
// More room is given to the lens and to the notes, up to these.
constexpr double kMostLens = 3;
constexpr double kMostGap = 1.2;

/// Height that longer notes leave free, so that not all is tight.
constexpr double kLoose = 1;

/// Ends with long labels take at most this part of the width.
constexpr double kMostEnds = 0.3;
/// The gap is enlarged to at most this part of a line, by the largest power of ten.
constexpr double kMostShown = 0.55;

/// Part of a text's row.
struct Stretch {
  double left = 0;
  double right = 0;
};

class CertaintyFigure {
 public:
  CertaintyFigure(Diagram& diagram, const Certainty& numbers, const CertaintyWords& words)
      : diagram_(diagram),
        numbers_(numbers),
        words_(words),
        em_(diagram.text_px()),
        left_(diagram.inside().x),
        right_(left_ + diagram.inside().width),
        units_(numbers.is_wrong() ? 2 : 1) {
    if (numbers.is_wrong()) return;
    for (Rational shown = numbers.gap() * 10; shown <= kMostShown; shown *= 10) ++exponent_;
  }

  /// @returns whether it had room
  /// @param title_px  its width
  bool add(double title_px) {
    const Formula definition = words_.definition();
    const double x = right_ - width(definition);
    is_defined_ = x >= left_ + title_px + 2 * kBetween * em_;
    if (is_defined_) add_label({definition, x}, title_y(), diagram_.palette().muted);
    place_line();
    place_marks();
    if (!place_rows()) return false;
    add_whole_line();
    if (exponent_ > 0) add_enlarged_line();
    add_notes();
    return true;
  }

 private:
  struct Label {
    Formula formula;
    double x = 0;  ///< left end
  };

  /// Baseline of the diagram's title.
  double title_y() const { return diagram_.inside().y - kBelowTitle * em_; }
  double width(const Formula& formula) const { return formula.width_em() * em_; }
  double x_of(const Rational& fraction) const {
    return line_.left + to_double(fraction / units_) * (line_.right - line_.left);
  }
  /// On the enlarged line, whose middle is that of the gap. @param offset  from pi/s
  double enlarged_x_of(const Rational& offset) const {
    const Rational share =
        (offset - numbers_.gap() / 2) * power(10, static_cast<unsigned long>(exponent_));
    return x_of(Rational(1, 2) + share);
  }

  /// Both lines have the labels of the first one's ends beside them.
  void place_line() {
    const double room = right_ - left_;
    for (const CertaintyWords::Pair& ends : words_.ends()) {
      ends_ = ends;
      if (width(ends.left) + width(ends.right) <= kMostEnds * room) break;
    }
    double beside = width(ends_.left);
    if (exponent_ > 0) beside = std::max(beside, width(words_.magnification(exponent_)));
    line_ = {left_ + beside + kBeside * em_, right_ - width(ends_.right) - kBeside * em_};
  }

  /// The labels of pi/s and pi/theta, left and right of the gap if possible.
  void place_marks() {
    const bool is_enlarged = exponent_ > 0;
    const Stretch room = is_enlarged
                             ? Stretch{line_.left + kBeside * em_, line_.right - kBeside * em_}
                             : Stretch{left_, right_};
    const double a = is_enlarged ? enlarged_x_of(0) : x_of(numbers_.fraction());
    const double b =
        is_enlarged ? enlarged_x_of(numbers_.gap()) : x_of(numbers_.fraction() + numbers_.gap());
    for (const CertaintyWords::Pair& pair : words_.marks()) {
      const double second = std::min(b, room.right - width(pair.right));
      const double first =
          std::max(room.left, std::min(a, second - kBetween * em_) - width(pair.left));
      marks_[0] = {pair.left, first};
      marks_[1] = {pair.right, std::max(second, first + width(pair.left) + kBetween * em_)};
      if (marks_[1].x + width(pair.right) <= room.right + 1e-6) break;
    }
    above_ = {marks_[0].x, marks_[1].x + width(marks_[1].formula)};
    if (!is_enlarged) return;
    // On the other line both are one.
    both_.formula = words_.both();
    const double at = x_of(numbers_.fraction());
    both_.x = std::clamp(at - width(both_.formula) / 2, left_,
                         std::max(left_, right_ - width(both_.formula)));
    above_ = {both_.x, both_.x + width(both_.formula)};
  }

  /// Lines of a text that fit. Nothing if a word is too long.
  std::optional<std::vector<Formula>> lines_of(const Words& words) const {
    std::vector<Formula> lines;
    for (const Formula& word : words) {
      if (width(word) > right_ - left_) return std::nullopt;
      Formula longer = lines.empty() ? word : lines.back() + words_.space() + word;
      if (!lines.empty() && width(longer) <= right_ - left_) {
        lines.back() = std::move(longer);
      } else {
        lines.push_back(word);
      }
    }
    return lines;
  }

  /// The longest notes, and what is beyond the line's end, as there is room.
  bool place_rows() {
    const double room = diagram_.inside().height / em_;
    double height = kCap + kToLine + kFromLine;
    if (exponent_ > 0) height += kLens + kToLine;
    double loose = kLoose;
    for (const std::vector<Words>& notes : words_.notes(is_defined_)) {
      notes_.clear();
      if (notes.size() == 1) loose = 0;
      double notes_height = kToNotes - kNoteStep - kBetweenNotes;
      bool fits = true;
      for (const Words& note : notes) {
        const auto lines = lines_of(note);
        fits = fits && lines;
        if (!lines) continue;
        notes_height += kBetweenNotes + kNoteStep * double(lines->size());
        notes_.push_back(*lines);
      }
      if (!fits || height + notes_height + loose > room) continue;
      place_beyond(room - height - notes_height);
      double spare = room - height - notes_height - (is_beyond_above_ ? kRow : 0);
      if (exponent_ > 0) lens_ += std::min(spare / 2, kMostLens);
      spare -= lens_ - kLens;
      gap_ = std::min(spare / 2, kMostGap);
      return true;
    }
    return false;
  }

  /// @param spare  height that is left, in ems
  void place_beyond(double spare) {
    for (const Formula& formula : words_.beyond()) {
      const double x = right_ - width(formula);
      if (x < left_) continue;
      const bool is_beside = x >= above_.right + kBetween * em_;
      if (!is_beside && spare < kRow) continue;
      beyond_ = {formula, x};
      is_beyond_above_ = !is_beside;
      return;
    }
  }

  void add_label(const Label& label, double baseline, const Color& color) {
    diagram_.formula(label.formula, {label.x, baseline}, 0, color);
  }

  void add_ticks(double y, const Rational& middle, long exponent) {
    // The least power of the base whose multiples are apart, in parts of the line.
    const int base = numbers_.base();
    const Rational zoom = power(10, static_cast<unsigned long>(exponent));
    const int units = exponent == 0 ? units_ : 1;
    const double least = units * kBetweenTicks * em_ / (line_.right - line_.left);
    Rational step = 1;
    while (to_double(step * zoom / base) >= least) step /= base;
    const Rational half = Rational(units) / (2 * zoom);
    const Integer last = floor((middle + half) / step);
    for (Integer k = ceil((middle - half) / step); k <= last; k += 1) {
      const Rational at = k * step;
      const double x = exponent == 0 ? x_of(at) : x_of(Rational(1, 2) + (at - middle) * zoom);
      const double reach = (at.get_den() == 1 ? kEndTick : kTick) * em_;
      diagram_.line({{x, y - reach}, {x, y + reach}}, diagram_.palette().muted);
    }
  }

  /// From pi/s to pi/theta.
  void add_band(double from, double to, double y) {
    const Palette& palette = diagram_.palette();
    const double reach = kBand * em_;
    diagram_.shape({{from, y - reach}, {to, y - reach}, {to, y + reach}, {from, y + reach}},
                   palette.accent);
    const double width = diagram_.sizes().data_line / diagram_.sizes().grid_line;
    const double tick = kEndTick * em_;
    diagram_.line({{from, y - tick}, {from, y + tick}}, palette.text, width);
    diagram_.line({{to, y - tick}, {to, y + tick}}, palette.accent, width);
  }

  void add_gap(double from, double to, double y) {
    const Formula formula = words_.gap();
    const double x = std::clamp((from + to - width(formula)) / 2, left_, right_ - width(formula));
    add_label({formula, x}, y + kFromLine * em_, diagram_.palette().accent);
  }

  void add_whole_line() {
    const Palette& palette = diagram_.palette();
    double baseline = diagram_.inside().y + kCap * em_;
    if (beyond_ && is_beyond_above_) {
      add_label(*beyond_, baseline, palette.muted);
      baseline += kRow * em_;
    } else if (beyond_) {
      add_label(*beyond_, baseline, palette.muted);
    }
    y_ = baseline + kToLine * em_;
    const double beside = y_ + kCap / 2 * em_;
    add_label({ends_.left, line_.left - kBeside * em_ - width(ends_.left)}, beside, palette.text);
    add_label({ends_.right, line_.right + kBeside * em_}, beside, palette.text);
    diagram_.line({{line_.left, y_}, {line_.right, y_}}, palette.muted);
    add_ticks(y_, Rational(units_, 2), 0);
    const double from = x_of(numbers_.fraction());
    const double to = x_of(numbers_.fraction() + numbers_.gap());
    add_band(from, to, y_);
    if (exponent_ > 0) {
      add_label(both_, baseline, palette.accent);
    } else {
      add_marks(baseline);
      if (numbers_.is_wrong()) {
        const Formula next = words_.next_whole();
        add_label({next, x_of(1) - width(next) / 2}, y_ + kFromLine * em_, palette.text);
      } else {
        add_gap(from, to, y_);
      }
    }
  }

  void add_marks(double baseline) {
    add_label(marks_[0], baseline, diagram_.palette().text);
    add_label(marks_[1], baseline, diagram_.palette().accent);
  }

  /// Below the first line, with lines of sight from the gap.
  void add_enlarged_line() {
    const Palette& palette = diagram_.palette();
    const double from = x_of(numbers_.fraction());
    const double to = x_of(numbers_.fraction() + numbers_.gap());
    const double above = y_ + kEndTick * em_;
    const double baseline = y_ + lens_ * em_;
    const double below = baseline - 0.95 * em_;
    y_ = baseline + kToLine * em_;
    diagram_.line({{from, above}, {line_.left, below}, {line_.left, y_}}, palette.grid);
    diagram_.line({{to, above}, {line_.right, below}, {line_.right, y_}}, palette.grid);
    const Formula times = words_.magnification(exponent_);
    add_label({times, line_.left - kBeside * em_ - width(times)}, y_ + kCap / 2 * em_,
              palette.muted);
    diagram_.line({{line_.left, y_}, {line_.right, y_}}, palette.muted);
    add_ticks(y_, numbers_.fraction() + numbers_.gap() / 2, exponent_);
    add_band(enlarged_x_of(0), enlarged_x_of(numbers_.gap()), y_);
    add_marks(baseline);
    add_gap(enlarged_x_of(0), enlarged_x_of(numbers_.gap()), y_);
  }

  void add_notes() {
    double baseline = y_ + (kFromLine + kToNotes + gap_) * em_;
    for (const std::vector<Formula>& lines : notes_) {
      const Color& color =
          &lines == &notes_.back() ? diagram_.palette().text : diagram_.palette().muted;
      for (const Formula& line : lines) {
        add_label({line, left_}, baseline, color);
        baseline += kNoteStep * em_;
      }
      baseline += kBetweenNotes * em_;
    }
  }

  Diagram& diagram_;
  const Certainty& numbers_;
  const CertaintyWords& words_;
  double em_;
  double left_;
  double right_;
  long exponent_ = 0;  ///< the second line is 10^n times as large; 0 if there is none
  int units_;          ///< length of the first line
  Stretch line_;
  CertaintyWords::Pair ends_;
  Label marks_[2];
  Label both_;
  Stretch above_;  ///< what labels above the first line take
  std::optional<Label> beyond_;
  bool is_beyond_above_ = false;
  bool is_defined_ = false;  ///< beside the title
  std::vector<std::vector<Formula>> notes_;
  double lens_ = kLens;
  double gap_ = 0;
  double y_ = 0;  ///< of the line that was added last
};

}  // namespace

Drawable certainty_panel(const DrawingContext& context, const PanelPlace& place) {
  const int base = context.scene.show.base;
  const std::optional<unsigned long> places = places_of_pi(context.scene.system, base);
  if (!places) {
    throw UsageError(fmt::format(
        "show.panels: the diagram 'certainty' is about the digits of pi, which this scene does "
        "not count; leave it out, or give a mass ratio of {}^(D-1) and a blue.velocity of 0",
        base * base));
  }
  const Certainty numbers(base, *places);
  const CertaintyWords words(context.setter(), numbers);
  const PanelTitle title = words.title();
  Diagram diagram(context, place, title);
  const auto width = [&](const Formula& text) { return text.width_em() * diagram.text_px(); };
  const double title_px = width(width(title.full) <= place.area.width ? title.full : title.brief);
  if (!CertaintyFigure(diagram, numbers, words).add(title_px)) {
    throw UsageError(fmt::format(
        "show.panels: the diagram 'certainty' has too little room in {:.0f}x{:.0f} pixels; leave "
        "something out, or make the frame larger",
        place.area.width, place.area.height));
  }
  diagram.finish();
  return unchanging({diagram.item()});
}

}  // namespace piblocks
