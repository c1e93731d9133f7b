#include "draw/formula.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "core/text.hpp"

namespace piblocks {
namespace {

// Of scripts, in ems of the text that they are attached to.
constexpr double kScriptScale = 0.65;
constexpr double kRaise = 0.4;
constexpr double kLower = 0.18;
constexpr double kAfterScript = 0.04;

// Reach of letters above and below the baseline, in ems.
constexpr double kLetterTop = 0.72;
constexpr double kSmallTop = 0.46;

// Of the root sign, in ems.
constexpr double kBarAbove = 0.09;
constexpr double kBarThickness = 0.07;
constexpr double kRootWidth = 0.56;
constexpr double kAfterRoot = 0.07;

std::string utf8_of(std::uint32_t code) {
  const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xC0 | code >> 6), byte(0x80 | (code & 0x3F))};
  return {byte(0xF0 | code >> 18), byte(0x80 | ((code >> 12) & 0x3F)),
          byte(0x80 | ((code >> 6) & 0x3F)), byte(0x80 | (code & 0x3F))};
}

/// The bold italic letter of Unicode's block "Mathematical Alphanumeric Symbols", which is as heavy
/// as text beside it; 0 if it has none. The live page's font has no others (src/web/reduce_fonts).
std::uint32_t italic_of(std::uint32_t code) {
  if (code >= 'A' && code <= 'Z') return 0x1D468 + (code - 'A');
  if (code >= 'a' && code <= 'z') return 0x1D482 + (code - 'a');
  if (code >= 0x3B1 && code <= 0x3C9) return 0x1D736 + (code - 0x3B1);
  return 0;
}

struct SmallFigure {
  std::string_view text;
  char plain;
  bool is_raised;
};
constexpr auto kSmallFigures = std::to_array<SmallFigure>(
    {{"⁰", '0', true},  {"¹", '1', true},  {"²", '2', true},  {"³", '3', true},  {"⁴", '4', true},
     {"⁵", '5', true},  {"⁶", '6', true},  {"⁷", '7', true},  {"⁸", '8', true},  {"⁹", '9', true},
     {"⁻", '-', true},  {"₀", '0', false}, {"₁", '1', false}, {"₂", '2', false}, {"₃", '3', false},
     {"₄", '4', false}, {"₅", '5', false}, {"₆", '6', false}, {"₇", '7', false}, {"₈", '8', false},
     {"₉", '9', false}});

const SmallFigure* small_figure_of(std::string_view character) {
  const auto* const found = std::ranges::find(kSmallFigures, character, &SmallFigure::text);
  return found == kSmallFigures.end() ? nullptr : found;
}

/// The root sign over something of this height and depth, up to the left end of its bar, and the
/// bar as far as `right`.
std::vector<Point> root_outline(double top, double bottom, double right) {
  const double bar = top + kBarAbove;
  const double over = bar + kBarThickness;
  const double foot = std::min(bottom, 0.0) - 0.12;
  const double middle = foot + 0.5 * (bar - foot);
  return {{0.03, middle - 0.05}, {0.17, middle + 0.045},
          {0.305, foot + 0.17},  {0.52, over},
          {right, over},         {right, bar},
          {0.56, bar},           {0.315, foot},
          {0.275, foot},         {0.135, middle - 0.025},
          {0.05, middle - 0.08}};
}

}  // namespace

void Formula::shift(double x, double y, double scale) {
  for (Mark& mark : marks_) {
    mark.x = x + mark.x * scale;
    mark.y = y + mark.y * scale;
    mark.scale *= scale;
  }
  width_em_ *= scale;
  top_em_ = y + top_em_ * scale;
  bottom_em_ = y + bottom_em_ * scale;
}

Formula& Formula::operator+=(const Formula& more) {
  Formula right = more;
  right.shift(width_em_, 0, 1);
  top_em_ = std::max(top_em_, right.top_em_);
  bottom_em_ = std::min(bottom_em_, right.bottom_em_);
  width_em_ += right.width_em_;
  std::ranges::move(right.marks_, std::back_inserter(marks_));
  return *this;
}

Formula Formula::colored(const Color& color) && {
  for (Mark& mark : marks_) mark.color = color;
  return std::move(*this);
}

void Formula::add_to(std::vector<DrawItem>& items, ItemId id, const Point& origin, double size_px,
                     const Color& color) const {
  for (std::size_t n = 0; n < marks_.size(); ++n) {
    const Mark& mark = marks_[n];
    const Color mark_color = mark.color.value_or(color);
    const Point at{origin.x + mark.x * size_px, origin.y - mark.y * size_px};
    const double em = mark.scale * size_px;
    if (const auto* text = std::get_if<Text>(&mark.shape)) {
      items.emplace_back(TextItem{nth(id, n), at, text->utf8, em, mark_color, text->face});
      continue;
    }
    std::vector<Point> outline;
    for (const Point& point : std::get<Outline>(mark.shape)) {
      outline.push_back({at.x + point.x * em, at.y - point.y * em});
    }
    items.emplace_back(PathItem{nth(id, n), std::move(outline), true, mark_color});
  }
}

Formula FormulaSetter::set(Face face, std::string_view utf8) const {
  Formula formula;
  formula.marks_.push_back({.shape = Formula::Text{face, std::string(utf8)}});
  formula.width_em_ = fonts_.of(face).width_em(utf8);
  constexpr std::string_view kSmall = "acegmnopqrsuvwxyz";
  const bool is_small = utf8.size() == 1 && kSmall.find(utf8) != std::string_view::npos;
  formula.top_em_ = is_small ? kSmallTop : kLetterTop;
  return formula;
}

Formula FormulaSetter::text(std::string_view utf8) const {
  Formula line;
  while (!utf8.empty()) {
    // A piece of plain characters, or of scripts of one kind.
    std::size_t size = 0;
    std::string plain;
    const SmallFigure* first = nullptr;
    while (size < utf8.size()) {
      const std::size_t length = step_bytes(utf8.substr(size));
      const SmallFigure* const script = small_figure_of(utf8.substr(size, length));
      if (size == 0) first = script;
      const bool is_alike = (script == nullptr) == (first == nullptr) &&
                            (script == nullptr || script->is_raised == first->is_raised);
      if (!is_alike) break;
      if (script != nullptr) plain += script->plain == '-' ? "−" : std::string(1, script->plain);
      size += length;
    }
    if (first == nullptr) {
      line += set(text_face_, utf8.substr(0, size));
    } else {
      const Formula scripts = set(text_face_, plain);
      line = first->is_raised ? raised(line, scripts) : lowered(line, scripts);
    }
    utf8.remove_prefix(size);
  }
  return line;
}

Formula FormulaSetter::digits(std::string_view utf8) const {
  return set(text_face_ == Face::article ? Face::article : Face::digits, utf8);
}

Formula FormulaSetter::italic(std::string_view utf8) const {
  Formula line;
  while (!utf8.empty()) {
    const std::uint32_t code = first_character(utf8).code;
    const std::size_t length_bytes = step_bytes(utf8);
    const std::uint32_t italic = italic_of(code);
    Formula letter = italic == 0 ? set(text_face_, utf8.substr(0, length_bytes))
                                 : set(Face::math, utf8_of(italic));
    const bool is_low =
        italic != 0 && (code == 'm' || code == 'v' || code == 'x' || code == 'y' || code == 0x3C0);
    if (is_low) letter.top_em_ = kSmallTop;
    line += letter;
    utf8.remove_prefix(length_bytes);
  }
  return line;
}

Formula FormulaSetter::with_script(const Formula& base, Formula script, double y_em) {
  script.shift(0, y_em, kScriptScale);
  script.bottom_em_ = y_em;
  Formula line = base + script;
  line.width_em_ += kAfterScript;
  return line;
}

// NOLINTBEGIN(readability-convert-member-functions-to-static): set.root() reads like set.text()
Formula FormulaSetter::root(const Formula& of) const {
  Formula content = of;
  content.shift(kRootWidth, 0, 1);
  const double right = kRootWidth + of.width_em_ + kAfterRoot / 2;
  Formula root;
  root.marks_.push_back({.shape = root_outline(content.top_em_, content.bottom_em_, right)});
  std::ranges::move(content.marks_, std::back_inserter(root.marks_));
  root.width_em_ = right + kAfterRoot / 2;
  root.top_em_ = content.top_em_ + kBarAbove + kBarThickness;
  root.bottom_em_ = content.bottom_em_;
  return root;
}

Formula FormulaSetter::raised(const Formula& base, const Formula& exponent) const {
  return with_script(base, exponent, kRaise);
}

Formula FormulaSetter::lowered(const Formula& base, const Formula& index) const {
  return with_script(base, index, -kLower);
}
// NOLINTEND(readability-convert-member-functions-to-static)

}  // namespace piblocks
