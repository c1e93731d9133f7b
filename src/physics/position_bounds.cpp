#include "physics/position_bounds.hpp"

#include <cmath>

#include "physics/exact_log.hpp"
#include "physics/unfolded_log.hpp"

namespace piblocks {

std::optional<PositionBounds> position_bounds(const CollisionLog& log, const Rational& time) {
  if (const auto* const form = dynamic_cast<const UnfoldedLog*>(&log)) return form->bounds_at(time);
  if (dynamic_cast<const ExactLog*>(&log) == nullptr) return std::nullopt;
  constexpr double kUnitRoundoff = 0x1p-53;
  const FreeFlight now = log.flight_at(time);
  return PositionBounds{kUnitRoundoff * std::fabs(now.blue.position),
                        kUnitRoundoff * std::fabs(now.red.position)};
}

}  // namespace piblocks
