#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <optional>

#include "draw/panels/certainty_plan.hpp"
#include "draw/panels/panels.hpp"
#include "scene/counted_pi.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kBelowTitle = 0.77;  ///< from its baseline to the inside
constexpr double kLeastBesideTitle = 2;
constexpr double kAboveMarks = 0.95;  ///< from the lens's lower end to the baseline of labels
constexpr double kEndTick = 0.42;     ///< half of its height, as of those below
constexpr double kSmallTick = 0.16;
constexpr double kBand = 0.24;
constexpr double kLeastStep = 0.8;  ///< between ticks

class CertaintyFigure {
 public:
  CertaintyFigure(Diagram& diagram, const Certainty& numbers, const CertaintyWords& words)
      : diagram_(diagram),
        palette_(diagram.palette()),
        numbers_(numbers),
        words_(words),
        em_(diagram.text_px()),
        right_(diagram.inside().x + diagram.inside().width) {}

  /// @returns whether it had room
  bool add() {
    const Formula definition = words_.definition();
    const double x = right_ - width(definition);
    const double title_right = diagram_.inside().x + diagram_.title_px();
    const bool is_defined = x >= title_right + kLeastBesideTitle * em_;
    const double title_y = diagram_.inside().y - kBelowTitle * em_;
    if (is_defined) add_label({definition, x}, title_y, palette_.muted);
    std::optional<CertaintyPlan> plan =
        plan_certainty({diagram_.inside(), em_, is_defined}, numbers_, words_);
    if (!plan) return false;
    plan_ = std::move(*plan);
    add_first_line();
    if (plan_.exponent > 0) add_enlarged_line();
    add_notes();
    return true;
  }

 private:
  double width(const Formula& formula) const { return formula.width_em() * em_; }
  const XRange& line() const { return plan_.line; }

  void add_label(const CertaintyPlan::Label& label, double baseline, const Color& color) {
    diagram_.formula(label.formula, {label.x, baseline}, 0, color);
  }
  void add_left_of_line(const Formula& formula, const Color& color) {
    const double x = line().left - certainty::kBeside * em_ - width(formula);
    add_label({formula, x}, y_ + certainty::kCap / 2 * em_, color);
  }
  void add_below_line(const Formula& formula, double x, const Color& color) {
    const double left =
        std::clamp(x - width(formula) / 2, diagram_.inside().x, right_ - width(formula));
    add_label({formula, left}, y_ + certainty::kFromLine * em_, color);
  }
  void add_marks(double baseline) {
    add_label(plan_.marks[0], baseline, palette_.text);
    add_label(plan_.marks[1], baseline, palette_.accent);
  }

  /// A line, and ticks at multiples of the least power of the base that leaves room between them.
  /// @param length  of what is on the line
  template <typename PlaceOf>
  void add_line(const Rational& middle, const Rational& length, const PlaceOf& place_of) {
    diagram_.line({{line().left, y_}, {line().right, y_}}, palette_.muted);
    const Rational base = numbers_.base();
    const double least = kLeastStep * em_ / (line().right - line().left);
    Rational step = 1;
    while (to_double(step / base / length) >= least) step /= base;
    const Integer last = floor((middle + length / 2) / step);
    for (Integer k = ceil((middle - length / 2) / step); k <= last; k += 1) {
      const Rational at = k * step;
      const double x = place_of(at);
      const double reach = (at.get_den() == 1 ? kEndTick : kSmallTick) * em_;
      diagram_.line({{x, y_ - reach}, {x, y_ + reach}}, palette_.muted);
    }
  }

  /// From pi/s to pi/theta.
  void add_band(const XRange& band) {
    const double top = y_ - kBand * em_;
    const double bottom = y_ + kBand * em_;
    diagram_.box({band.left, top, band.right - band.left, bottom - top}, palette_.accent);
    const double width = diagram_.data_width();
    const double tick = kEndTick * em_;
    diagram_.line({{band.left, y_ - tick}, {band.left, y_ + tick}}, palette_.text, width);
    diagram_.line({{band.right, y_ - tick}, {band.right, y_ + tick}}, palette_.accent, width);
  }

  void add_first_line() {
    double baseline = diagram_.inside().y + certainty::kCap * em_;
    if (plan_.next_whole_meaning) add_label(*plan_.next_whole_meaning, baseline, palette_.muted);
    if (plan_.has_row_above) baseline += certainty::kRow * em_;
    y_ = baseline + certainty::kToLine * em_;
    add_left_of_line(plan_.ends.left, palette_.text);
    add_label({plan_.ends.right, line().right + certainty::kBeside * em_},
              y_ + certainty::kCap / 2 * em_, palette_.text);
    add_line(Rational(plan_.units, 2), plan_.units,
             [&](const Rational& at) { return plan_.x_of(at); });
    band_ = {plan_.x_of(numbers_.fraction()), plan_.x_of(numbers_.fraction() + numbers_.excess())};
    add_band(band_);
    if (plan_.mark_names) {
      add_label(*plan_.mark_names, baseline, palette_.accent);
      return;
    }
    add_marks(baseline);
    if (numbers_.is_wrong()) {
      add_below_line(words_.next_whole(), plan_.x_of(1), palette_.text);
    } else {
      add_below_line(words_.excess_label(), (band_.left + band_.right) / 2, palette_.accent);
    }
  }

  /// Below the first line, with lines of sight from the band.
  void add_enlarged_line() {
    const double eye = y_ + kEndTick * em_;
    const double baseline = y_ + plan_.lens_em * em_;
    const double top = baseline - kAboveMarks * em_;
    y_ = baseline + certainty::kToLine * em_;
    diagram_.line({{band_.left, eye}, {line().left, top}, {line().left, y_}}, palette_.grid);
    diagram_.line({{band_.right, eye}, {line().right, top}, {line().right, y_}}, palette_.grid);
    add_left_of_line(words_.magnification(plan_.exponent), palette_.muted);
    const Rational length = 1 / power(10, static_cast<unsigned long>(plan_.exponent));
    const auto place_of = [&](const Rational& at) { return plan_.enlarged_x_of(at); };
    add_line(plan_.middle, length, place_of);
    add_band({place_of(numbers_.fraction()), place_of(numbers_.fraction() + numbers_.excess())});
    add_marks(baseline);
    add_below_line(words_.excess_label(), place_of(plan_.middle), palette_.accent);
  }

  /// The last one is what to remember.
  void add_notes() {
    double baseline = y_ + (certainty::kFromLine + certainty::kToNotes + plan_.notes_em) * em_;
    for (const std::vector<Formula>& lines : plan_.notes) {
      const bool is_last = &lines == &plan_.notes.back();
      for (const Formula& text : lines) {
        add_label({text, diagram_.inside().x}, baseline, is_last ? palette_.text : palette_.muted);
        baseline += certainty::kNoteStep * em_;
      }
      baseline += certainty::kBetweenNotes * em_;
    }
  }

  Diagram& diagram_;
  const Palette& palette_;
  const Certainty& numbers_;
  const CertaintyWords& words_;
  double em_;
  double right_;
  CertaintyPlan plan_;
  XRange band_;   ///< on the first line
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
  Diagram diagram(context, place, words.titles());
  if (!CertaintyFigure(diagram, numbers, words).add()) {
    throw UsageError(fmt::format(
        "show.panels: the diagram 'certainty' has too little room in {:.0f}x{:.0f} pixels; leave "
        "something out, or make the frame larger",
        place.area.width, place.area.height));
  }
  diagram.finish();
  return unchanging({diagram.item()});
}

}  // namespace piblocks
