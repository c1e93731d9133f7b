// The number of collisions against time, as a line of any width.
// In: a log, a span of time, how many columns a picture has for it. Out: the line's corners, with
// exact counts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/schedule.hpp"

namespace piblocks {

struct CountPoint {
  double share = 0;  ///< of the span, 0 … 1
  Integer count;
};

/// A staircase where collisions are apart: each step is upright, at its time to 1/64 of a column.
/// Where a column has more than two, a straight line from count to count at the column's ends.
/// Collisions at the very beginning are a step at share 0.
/// @param columns  >= 1
/// @throws SimulationError as Log::state_at().
std::vector<CountPoint> count_curve(const Log& log, const Span& span, int columns);

/// A round factor, 1, 2 or 5 times a power of ten.
struct RoundFactor {
  int digit = 1;
  long exponent = 0;

  Rational value() const;
  /// "200", "5×10⁷"
  std::string text() const;
  RoundFactor next() const;
};

/// The greatest round factor that is not above the value. @param value  >= 1
RoundFactor round_factor_below(const Rational& value);

/// Part of a curve of counts, enlarged around the turn until single steps are seen.
struct EnlargedTurn {
  Span span;
  RoundFactor time_factor;
  RoundFactor count_factor;
  Integer low;  ///< count at the span's beginning
  Integer high;
};

/// Limits for the inset of the count's curve.
struct InsetLimits {
  Span span;                  ///< time that the picture shows
  Rational width_share;       ///< width of the enlarged part, as a share of the picture's
  int most_steps = 1;         ///< collisions in the enlarged part, at most
  Rational counts_in_height;  ///< counts that fill the inset's height at the scale of the curve
};

/// Nothing if there is no turn within the span, nothing to enlarge, or all collisions happen at
/// once.
std::optional<EnlargedTurn> enlarged_turn(const Log& log, const InsetLimits& limits);

}  // namespace piblocks
