// What the panel of certainty says, from long wordings to short ones.
// In: exact numbers. Out: formulas.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "draw/formula.hpp"
#include "draw/panels/certainty.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {

/// A text as words, which may be broken into lines between them.
using Words = std::vector<Formula>;

class CertaintyWords {
 public:
  /// @param setter     of fonts that outlive it
  /// @param certainty  must outlive it
  CertaintyWords(const FormulaSetter& setter, const Certainty& certainty);

  std::vector<Formula> titles() const;  ///< from the longest to the shortest
  struct Pair {
    Formula left;
    Formula right;
  };
  // From the longest to the shortest.
  std::vector<Pair> ends() const;                   ///< the whole numbers on both sides of pi/s
  std::vector<Pair> marks() const;                  ///< pi/s and pi/theta with their digits
  std::vector<Formula> next_whole_meaning() const;  ///< what the next whole number would mean
  /// Each is a list of paragraphs. @param is_defined  whether definition() is shown
  std::vector<std::vector<Words>> notes(bool is_defined) const;

  Formula definition() const;  ///< of theta and s

  Formula mark_names() const;                  ///< of both marks
  Formula excess_label() const;                ///< of pi/theta - pi/s
  Formula magnification(long exponent) const;  ///< by a power of ten
  Formula next_whole() const { return set_.text(next_whole_text()); }
  Formula space() const { return set_.text(" "); }

 private:
  Words words(const std::string& text) const;
  Formula theta() const;
  Formula pi_over_theta() const;
  Formula pi_over_s() const;  ///< "100 π"
  /// "nines", "ones", "digits f": the largest digit of the base, in the plural.
  std::string largest_digits() const;
  std::string next_whole_text() const;
  std::string one_more() const;
  bool is_small() const;

  Words ratio() const;
  Words reason(bool is_defined) const;
  Words distance() const;
  Words needed() const;
  Words needed_briefly() const;

  FormulaSetter set_;
  const Certainty& numbers_;
  std::size_t nines_;
};

}  // namespace piblocks
