// Logs that know positions and gaps to a few roundings: all but those of the engines that step.
// In: a time, or the index of a collision. Out: gaps, and bounds of the errors of positions.
#pragma once

#include <piblocks/run.hpp>

namespace piblocks {

class PreciseLog : public CollisionLog {
 public:
  /// The error of state_at(time).
  virtual PositionBounds bounds_at(const Rational& time) const = 0;
  /// As the functions of these names in run.hpp.
  virtual Gaps gaps_at(const Rational& time) const = 0;
  virtual Gaps gaps_at_collision(const Integer& index) const = 0;

 protected:
  using CollisionLog::CollisionLog;
};

}  // namespace piblocks
