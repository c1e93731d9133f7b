#include "draw/panels/count_curve.hpp"

#include <fmt/format.h>

#include "draw/number_text.hpp"

namespace piblocks {
namespace {

/// More collisions than this in a column are a straight line.
constexpr int kMostSteps = 2;
constexpr int kHalvings = 6;
/// A picture does not show so small a part of a span.
constexpr long kNegligible = 1'000'000'000'000;
/// Beyond this all collisions happen at once.
constexpr long kMostExponent = 640;

/// When the count reaches k, to 1/64 of the column. @param from, to  the column
Rational time_of_step(const Log& log, const Integer& k, Rational from, Rational to) {
  for (int i = 0; i < kHalvings; ++i) {
    const Rational middle = (from + to) / 2;
    (log.count_at(middle) >= k ? to : from) = middle;
  }
  return (from + to) / 2;
}

}  // namespace

std::vector<CountPoint> count_curve(const Log& log, const Span& span, int columns) {
  const Rational length = span.to - span.from;
  std::vector<CountPoint> points;
  Integer count = log.count_at(span.from - length / kNegligible);
  points.push_back({0, count});
  const Integer first = log.count_at(span.from);
  if (first != count) points.push_back({0, first});
  count = first;
  for (int i = 1; i <= columns; ++i) {
    const Rational to = span.from + length * i / columns;
    const Integer next = log.count_at(to);
    if (next - count <= kMostSteps) {
      const Rational from = span.from + length * (i - 1) / columns;
      for (Integer k = count + 1; k <= next; k += 1) {
        const double share = to_double((time_of_step(log, k, from, to) - span.from) / length);
        points.push_back({share, k - 1});
        points.push_back({share, k});
      }
    } else {
      points.push_back({double(i - 1) / columns, count});
      points.push_back({double(i) / columns, next});
    }
    count = next;
  }
  points.push_back({1, count});
  return points;
}

Rational RoundFactor::value() const { return digit * power_of_ten(exponent); }

std::string RoundFactor::text() const {
  constexpr long kLeastPower = 5;
  if (exponent < kLeastPower) return fixed_text(to_double(value()), 0);
  return (digit == 1 ? "" : fmt::format("{}×", digit)) + power_text(exponent);
}

RoundFactor RoundFactor::next() const {
  if (digit == 5) return {1, exponent + 1};
  return {digit == 1 ? 2 : 5, exponent};
}

RoundFactor round_factor_below(const Rational& value) {
  RoundFactor factor{1, magnitude_of(value).exponent};
  while (factor.next().value() <= value) factor = factor.next();
  return factor;
}

std::optional<EnlargedTurn> enlarged_turn(const Log& log, const InsetLimits& limits) {
  const Span& span = limits.span;
  const std::optional<Rational> turn = turn_of(log);
  if (!turn || *turn <= span.from || *turn >= span.to) return std::nullopt;
  const Rational half = (span.to - span.from) * limits.width_share / 2;
  EnlargedTurn part;
  const auto fits = [&](const RoundFactor& factor) {
    part.time_factor = factor;
    part.span = {*turn - half / factor.value(), *turn + half / factor.value()};
    part.low = log.count_at(part.span.from);
    part.high = log.count_at(part.span.to);
    const Integer steps = part.high - part.low;
    return steps <= limits.most_steps && steps <= limits.counts_in_height;
  };
  RoundFactor factor;
  if (fits(factor)) return std::nullopt;
  while (!fits({1, factor.exponent + 1})) {
    if (++factor.exponent > kMostExponent) return std::nullopt;
  }
  while (!fits(factor)) factor = factor.next();
  if (part.high - part.low < 2) return std::nullopt;
  part.count_factor = round_factor_below(limits.counts_in_height / (part.high - part.low));
  return part;
}

}  // namespace piblocks
