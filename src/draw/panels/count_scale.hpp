// An axis of counts of any size.
// In: a log, a span of time, a base. Out: the counts at both ends, and round ones between them.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "draw/number_text.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// The axis of counts, beside that of time.
struct CountScale {
  CountScale(const Log& log, const Span& span, int count_base)
      : base(count_base),
        low(std::min(Integer(0), log.count_at(span.from))),
        high(std::max(Integer(low + 1), log.count_at(span.to))) {}

  /// @param least  counts between figures
  void place_figures(const Rational& least) {
    Rational step = std::max(Rational(1), round_step(least));
    if (base != kUsualBase) {
      step = 1;
      while (step < least) step *= base;
    }
    values.clear();
    for (Integer k = ceil(low / step); k * step <= high; k += 1) values.emplace_back(k * step);
    exponent = magnitude_of(step).exponent;
  }

  std::string text(const Integer& value) const {
    constexpr long kMostPlain = 1'000'000;
    if (base != kUsualBase || high < kMostPlain) return count_text(value, base);
    if (value == 0) return "0";
    const Rational multiple = value / power_of_ten(exponent);
    const std::string power = power_text(exponent);
    return multiple == 1 ? power : fixed_text(to_double(multiple), 0) + "×" + power;
  }

  int base;
  Integer low;
  Integer high;
  std::vector<Integer> values;  ///< with figures
  long exponent = 0;            ///< of ten, of the step between them
};

}  // namespace piblocks
