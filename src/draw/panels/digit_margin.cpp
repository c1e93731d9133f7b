#include "draw/panels/digit_margin.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cassert>
#include <optional>
#include <sstream>

#include "core/real.hpp"
#include "draw/number_text.hpp"
#include "draw/panels/panels.hpp"
#include "draw/text_lines.hpp"
#include "scene/counted_pi.hpp"

namespace piblocks {
namespace {

constexpr mpfr_prec_t kSpare_bits = 128;

mpfr_prec_t bits_of(const Integer& value) {
  return static_cast<mpfr_prec_t>(mpz_sizeinbase(value.get_mpz_t(), 2));
}

/// arctan(1 / scale)
Real theta_of(const Rational& scale, mpfr_prec_t bits) { return atan(Real(bits, 1 / scale)); }

/// floor(value · scale) of an irrational number, which `value` has to any precision.
/// @param size_bits  of the result, at least
template <typename Value>
Integer floor_of(const Value& value, const Rational& scale, mpfr_prec_t size_bits) {
  constexpr mpfr_prec_t kMore_bits = 64;
  constexpr long kRoundings_bits = 8;
  for (mpfr_prec_t bits = size_bits + kMore_bits;; bits += kMore_bits) {
    const Real nearest = value(bits) * Real(bits, scale);
    const Real error = scaled(nearest, kRoundings_bits - bits);
    Integer below = (nearest - error).floor();
    if (below == (nearest + error).floor()) return below;
  }
}

Rational power_of(int base, std::size_t exponent) {
  return power(base, static_cast<unsigned long>(exponent));
}

/// Of the number value / base^digits.
std::string text_of(const Integer& value, int base, std::size_t digits) {
  const Integer scale = power_of(base, digits).get_num();
  const Integer whole = value / scale;
  std::string text = count_text(whole, base);
  if (digits == 0) return text;
  const std::string rest = Integer(value % scale).get_str(base);
  return text + '.' + std::string(digits - rest.size(), '0') + rest;
}

std::string behind_point(const std::string& text) { return text.substr(text.find('.') + 1); }

}  // namespace

DigitMargin::DigitMargin(int base, unsigned long places)
    : base_(base), places_(places), scale_(power(base, places)) {
  assert(base >= kMinBase && base <= kMaxBase);
  // pi/s and pi/theta have the first two thirds of these bits in common.
  const mpfr_prec_t bits = 3 * bits_of(scale_.get_num()) + 2 * kSpare_bits;
  const Real scaled_pi = Real::pi(bits) * Real(bits, scale_);
  const Real rays = Real::pi(bits) / theta_of(scale_, bits);
  whole_ = floor_of(Real::pi, scale_, bits_of(scale_.get_num()) + 2);
  fraction_ = (scaled_pi - whole_).to_rational();
  excess_ = (rays - scaled_pi).to_rational();
  if (places == 0) excess_ = 1 - fraction_;  // pi/theta is 4
}

std::string DigitMargin::scaled_pi(std::size_t digits) const {
  const Rational scale = scale_ * power_of(base_, digits);
  return text_of(floor_of(Real::pi, scale, bits_of(scale.get_num()) + 2), base_, digits);
}

std::string DigitMargin::pi_over_theta(std::size_t digits) const {
  if (places_ == 0) return count_text(whole_ + 1, base_);
  // By Niven's theorem arctan s is no rational part of pi for a rational s below 1.
  const auto rays = [&](mpfr_prec_t bits) { return Real::pi(bits) / theta_of(scale_, bits); };
  const Rational scale = power_of(base_, digits);
  const mpfr_prec_t size = bits_of(scale.get_num()) + bits_of(scale_.get_num()) + 2;
  return text_of(floor_of(rays, scale, size), base_, digits);
}

std::string DigitMargin::following(std::size_t digits) const {
  return behind_point(scaled_pi(digits));
}

std::string DigitMargin::needed(std::size_t digits) const {
  // One more ray is crossed if (whole + 1) theta < pi.
  const Rational rays = whole_ + 1;
  const auto least_pi = [&](mpfr_prec_t bits) { return Real(bits, rays) * theta_of(scale_, bits); };
  const Rational scale = scale_ * power_of(base_, digits);
  return behind_point(
      text_of(floor_of(least_pi, scale, bits_of(scale.get_num()) + 2), base_, digits));
}

std::size_t DigitMargin::nines() const {
  const char nine = Integer(base_ - 1).get_str(base_).front();
  // What is needed is less than 2 s below the next whole number.
  const std::string digits = needed(places_ + 2);
  return static_cast<std::size_t>(std::ranges::find_if(digits, [&](char c) { return c != nine; }) -
                                  digits.begin());
}

namespace {

// In ems.
constexpr double kCap = 0.73;      ///< from a text's top to its baseline
constexpr double kToLine = 0.75;   ///< from the baseline of labels down to their line
constexpr double kFromLine = 1.3;  ///< from the line down to the baseline of the label below it
constexpr double kToNotes = 1.7;   ///< from there to the first line of notes
constexpr double kLineStep = 1.25;
constexpr double kBeside = 0.5;    ///< between the line and the labels of its ends
constexpr double kBetween = 1;     ///< between labels side by side
constexpr double kEndTick = 0.42;  ///< half of its height, as of the next two
constexpr double kSmallTick = 0.16;
constexpr double kBand = 0.24;
constexpr double kLeastStep = 0.8;  ///< between ticks

/// Up to so many places numbers are written out.
constexpr unsigned long kFewPlaces = 5;
constexpr std::size_t kFewNines = 5;

struct Pair {
  Formula left;
  Formula right;
};

/// What the panel says.
class MarginWords {
 public:
  MarginWords(const FormulaSetter& setter, const DigitMargin& numbers)
      : set_(setter), numbers_(numbers), nines_(numbers.nines()) {}

  /// From the longest to the shortest.
  std::vector<Formula> titles() const {
    if (numbers_.is_wrong()) {
      return set_.texts(
          {"Could a digit be wrong? Here the last one is", "The last digit is wrong"});
    }
    if (nines_ == 0) {
      return set_.texts({"Could a digit be wrong? Not here", "No digit is wrong"});
    }
    return {set_.text("Could a digit be wrong? Only if " + largest_digits() + " followed"),
            set_.text("Only " + largest_digits() + " could mislead it")};
  }
  /// The whole numbers at both ends of the line, from the longest to the shortest.
  std::vector<Pair> ends() const {
    const Integer right = numbers_.whole() + (numbers_.is_wrong() ? 2 : 1);
    std::vector<Pair> ends;
    for (const std::size_t length : {std::string::npos, std::size_t{7}, std::size_t{3}}) {
      ends.push_back({end_of(numbers_.whole(), length), end_of(right, length)});
    }
    return ends;
  }
  /// pi/s and pi/theta, with their digits, if these tell them apart, and without.
  std::vector<Pair> marks() const {
    constexpr std::size_t kDigits = 3;
    const std::string pi = numbers_.scaled_pi(kDigits);
    const std::string rays = numbers_.pi_over_theta(kDigits);
    const Pair names{pi_over_s(), pi_over_theta()};
    if (pi == rays) return {names};
    return {{names.left + set_.text(" = " + pi + "…"),
             names.right + set_.text(" = " + rays + (numbers_.places() == 0 ? "" : "…"))},
            names};
  }
  Formula excess() const {
    const Formula product = set_.text("π") + set_.italic("s") + set_.text("/3");
    const std::string value = short_text(numbers_.excess());
    return numbers_.places() == 0 ? set_.text(value) : set_.text(value + " ≈ ") + product;
  }
  /// "θ = arctan s, s = 10⁻²"
  Formula definition() const {
    const Formula power = set_.raised(set_.text(std::to_string(numbers_.base())),
                                      set_.text("−" + std::to_string(numbers_.places())));
    return set_.italic("θ") + set_.text(" = arctan ") + set_.italic("s") + set_.text(", ") +
           set_.italic("s") + set_.text(" = ") + (numbers_.places() == 0 ? set_.text("1") : power);
  }
  /// What another digit would need, at length and in short.
  std::vector<std::string> needs() const {
    if (numbers_.places() == 0) {
      return {"For one more collision, π/θ would have to be more than 4; it is 4 exactly."};
    }
    constexpr std::size_t kAfterNines = 3;
    const std::size_t counted = numbers_.whole().get_str(numbers_.base()).size();
    if (nines_ > kFewNines) {
      const std::string found = numbers_.following(2 * kAfterNines);
      return {fmt::format("One more collision would need {} {} after these {} digits of π; it goes "
                          "on with {}…",
                          nines_, largest_digits(), counted, found),
              fmt::format("Needed next in π: {} {}. Found: {}…", nines_, largest_digits(), found)};
    }
    const std::string begun = pi_digits(numbers_.base(), counted);
    const std::string wanted = numbers_.needed(nines_ + kAfterNines);
    const std::string found = numbers_.following(nines_ + kAfterNines);
    if (numbers_.is_wrong()) {
      return {
          fmt::format("With {}… or more after {} there is one more collision; π goes on with {}…",
                      wanted, begun, found)};
    }
    return {fmt::format("For one more collision, {} would have to go on with {}… or more; π goes "
                        "on with {}…",
                        begun, wanted, found),
            fmt::format("Needed next in π: {}… Found: {}…", wanted, found)};
  }
  /// A sentence as words, between which it may be broken.
  std::vector<Formula> words_of(const std::string& text) const {
    std::istringstream stream(text);
    std::vector<Formula> words;
    for (std::string word; stream >> word;) words.push_back(set_.text(word));
    return words;
  }
  Formula space() const { return set_.text(" "); }

 private:
  Formula pi_over_theta() const { return set_.text("π/") + set_.italic("θ"); }
  /// "100 π"
  Formula pi_over_s() const {
    const unsigned long places = numbers_.places();
    if (places == 0) return set_.text("π");
    if (places == 1 || (numbers_.base() == kUsualBase && places <= kFewPlaces)) {
      return set_.text(with_thousands_separators(power(numbers_.base(), places).get_num()) + " π");
    }
    return set_.raised(set_.text(std::to_string(numbers_.base())),
                       set_.text(std::to_string(places))) +
           set_.text(" π");
  }
  /// The last characters of a whole number: "…932,384".
  Formula end_of(const Integer& value, std::size_t length) const {
    const std::string text = count_text(value, numbers_.base());
    return set_.text(text.size() <= length ? text : "…" + text.substr(text.size() - length));
  }
  /// The largest digit of the base, in the plural: "nines", "ones", "digits f".
  std::string largest_digits() const {
    if (numbers_.base() == kUsualBase) return "nines";
    if (numbers_.base() == 2) return "ones";
    return "digits " + Integer(numbers_.base() - 1).get_str(numbers_.base());
  }

  FormulaSetter set_;
  const DigitMargin& numbers_;
  std::size_t nines_;
};

/// The numbers pi/s and pi/theta on a line between two whole numbers, and what would have to follow
/// in pi for another digit.
class MarginFigure {
 public:
  MarginFigure(Diagram& diagram, const DigitMargin& numbers, const MarginWords& words)
      : diagram_(diagram),
        palette_(diagram.palette()),
        numbers_(numbers),
        words_(words),
        units_(numbers.is_wrong() ? 2 : 1),
        em_(diagram.text_px()),
        left_(diagram.inside().x),
        right_(left_ + diagram.inside().width),
        y_(diagram.inside().y + (kCap + kToLine) * em_) {}

  /// @returns whether it had room
  bool add() {
    add_line();
    add_marks();
    return add_notes();
  }

 private:
  double width(const Formula& formula) const { return formula.width_em() * em_; }
  double x_of(const Rational& fraction) const {
    return line_left_ + to_double(fraction / units_) * (line_right_ - line_left_);
  }
  void label(const Formula& formula, double x, double baseline, const Color& color) {
    diagram_.formula(formula, {x, baseline}, 0, color);
  }

  /// With ticks at multiples of the least power of the base that leaves room between them.
  void add_line() {
    constexpr double kMostEnds = 0.3;  // of the width
    std::vector<Pair> all = words_.ends();
    const auto fits = [&](const Pair& ends) {
      return width(ends.left) + width(ends.right) <= kMostEnds * (right_ - left_);
    };
    const auto found = std::ranges::find_if(all, fits);
    const Pair& ends = found == all.end() ? all.back() : *found;
    line_left_ = left_ + width(ends.left) + kBeside * em_;
    line_right_ = right_ - width(ends.right) - kBeside * em_;
    label(ends.left, left_, y_ + kCap / 2 * em_, palette_.text);
    label(ends.right, line_right_ + kBeside * em_, y_ + kCap / 2 * em_, palette_.text);
    diagram_.line({{line_left_, y_}, {line_right_, y_}}, palette_.muted);
    const double least = kLeastStep * em_ / (line_right_ - line_left_);
    Rational step = 1;
    while (to_double(step / numbers_.base() / units_) >= least) step /= numbers_.base();
    for (Rational at = 0; at <= units_; at += step) {
      const double reach = (at.get_den() == 1 ? kEndTick : kSmallTick) * em_;
      diagram_.line({{x_of(at), y_ - reach}, {x_of(at), y_ + reach}}, palette_.muted);
    }
  }

  /// The band from pi/s to pi/theta, and what it is.
  void add_marks() {
    const double from = x_of(numbers_.fraction());
    const double to = x_of(numbers_.fraction() + numbers_.excess());
    diagram_.box({from, y_ - kBand * em_, to - from, 2 * kBand * em_}, palette_.accent);
    const double tick = kEndTick * em_;
    const double stroke = diagram_.data_width();
    diagram_.line({{from, y_ - tick}, {from, y_ + tick}}, palette_.text, stroke);
    diagram_.line({{to, y_ - tick}, {to, y_ + tick}}, palette_.accent, stroke);
    const double baseline = y_ - kToLine * em_;
    for (const Pair& marks : words_.marks()) {
      const double both = width(marks.left) + kBetween * em_ + width(marks.right);
      if (both > right_ - left_) continue;
      const double x = std::max(left_, std::min(from - width(marks.left), right_ - both));
      const double second = x + width(marks.left) + kBetween * em_;
      label(marks.left, x, baseline, palette_.text);
      label(marks.right, std::max(second, std::min(to, right_ - width(marks.right))), baseline,
            palette_.accent);
      break;
    }
    const Formula excess = words_.excess();
    const double x = std::max(
        line_left_, std::min((from + to - width(excess)) / 2, line_right_ - width(excess)));
    label(excess, x, y_ + kFromLine * em_, palette_.accent);
  }

  /// What is needed, and before it, if there is room, what theta and s are.
  bool add_notes() {
    const double room = (diagram_.inside().bottom() - y_) / em_ - kFromLine;
    const auto fits = [&](const Formula& line) { return width(line) <= right_ - left_; };
    double baseline = y_ + (kFromLine + kToNotes) * em_;
    for (const std::string& text : words_.needs()) {
      const std::vector<Formula> lines = filled_lines(words_.words_of(text), words_.space(), fits);
      double height = kToNotes + kLineStep * double(lines.size() - 1);
      if (height > room || !std::ranges::all_of(lines, fits)) continue;
      if (height + kLineStep <= room && fits(words_.definition())) {
        label(words_.definition(), left_, baseline, palette_.muted);
        baseline += kLineStep * em_;
      }
      for (const Formula& line : lines) {
        label(line, left_, baseline, palette_.text);
        baseline += kLineStep * em_;
      }
      return true;
    }
    return false;
  }

  Diagram& diagram_;
  const Palette& palette_;
  const DigitMargin& numbers_;
  const MarginWords& words_;
  int units_;  ///< length of the line
  double em_;
  double left_;
  double right_;
  double y_;  ///< of the line
  double line_left_ = 0;
  double line_right_ = 0;
};

}  // namespace

Drawable certainty_panel(const DrawingContext& context, const PanelPlace& place) {
  const int base = context.scene.show.base;
  const std::optional<unsigned long> places = places_of_pi(context.two_blocks().blocks(), base);
  if (!places) {
    throw UsageError(
        "show.panels",
        fmt::format(
            "the diagram 'certainty' is about the digits of pi, which this scene does "
            "not count; leave it out, or give a mass ratio of {}^(D-1) and a blue.velocity of 0",
            base * base));
  }
  const DigitMargin numbers(base, *places);
  const MarginWords words(context.setter(), numbers);
  Diagram diagram(context, place, words.titles());
  if (!MarginFigure(diagram, numbers, words).add()) {
    throw UsageError(
        "show.panels",
        fmt::format("the diagram 'certainty' has too little room in {:.0f}x{:.0f} pixels; leave "
                    "something out, or make the frame larger",
                    place.area.width, place.area.height));
  }
  diagram.finish();
  return unchanging({diagram.item()});
}

}  // namespace piblocks
