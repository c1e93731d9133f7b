// A line of text and mathematics: italic letters, roots, raised and lowered parts.
// In: parts, put together by functions. Out: text items, rules and root signs at a place.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/font.hpp"

namespace piblocks {

/// All lengths are in ems of the line; y is up from its baseline.
class Formula {
 public:
  Formula() = default;

  double width_em() const noexcept { return width_em_; }

  /// Sets `more` to the right of it.
  Formula& operator+=(const Formula& more);
  friend Formula operator+(Formula a, const Formula& b) { return a += b; }
  /// The same in another colour than the line's.
  Formula colored(const Color& color) &&;

  /// @param origin  left end of the baseline
  /// @param id      of the first item; the others get the ids after it
  void add_to(std::vector<DrawItem>& items, ItemId id, const Point& origin, double size_px,
              const Color& color) const;

 private:
  friend class FormulaSetter;

  struct Text {
    Face face;
    std::string utf8;
  };
  using Outline = std::vector<Point>;  ///< filled
  struct Mark {
    std::variant<Text, Outline> shape;
    double x = 0;
    double y = 0;
    double scale = 1;
    std::optional<Color> color = {};
  };

  void shift(double x, double y, double scale);

  std::vector<Mark> marks_;
  double width_em_ = 0;
  double top_em_ = 0;     ///< of its highest mark above the baseline
  double bottom_em_ = 0;  ///< of its lowest mark, negative below the baseline
};

/// Makes formulas; the fonts must outlive it.
class FormulaSetter {
 public:
  /// @param text_face  of upright text
  FormulaSetter(const Fonts& fonts, Face text_face) : fonts_(fonts), text_face_(text_face) {}

  /// Upright text. Superscripts and subscripts of Unicode are raised and lowered figures.
  Formula text(std::string_view utf8) const;
  /// One of each, such as wordings of a title.
  std::vector<Formula> texts(std::initializer_list<std::string_view> lines) const {
    std::vector<Formula> all;
    for (const std::string_view line : lines) all.push_back(text(line));
    return all;
  }
  /// Text in digits of equal width.
  Formula digits(std::string_view utf8) const;
  /// Letters, Latin or small Greek ones, in italics; other characters stay upright.
  Formula italic(std::string_view utf8) const;
  Formula root(const Formula& of) const;
  Formula raised(const Formula& base, const Formula& exponent) const;
  Formula lowered(const Formula& base, const Formula& index) const;

 private:
  Formula set(Face face, std::string_view utf8) const;
  static Formula with_script(const Formula& base, Formula script, double y_em);

  const Fonts& fonts_;
  Face text_face_;
};

}  // namespace piblocks
